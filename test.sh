#!/usr/bin/env bash
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")"
source .ci/setup.sh

usage() {
    cat <<'USAGE'
Usage: ./test.sh [--help]

Installs what is missing (Debian 12, apt), then builds and tests:
  preset dev   all tests but the slow ones (labels unit, shader, golden)
  preset asan  unit tests under AddressSanitizer and UndefinedBehaviorSanitizer
Slow tests:            ctest --test-dir build/dev -L slow --output-on-failure
ThreadSanitizer:       cmake --preset tsan && cmake --build --preset tsan && ctest --preset tsan

Exit codes: 0 all passed; 1 a build or a test failed; 2 a package is missing and cannot be
installed here (the command for an administrator is printed), or a wrong option.
USAGE
}

case ${1:-} in
'') ;;
--help | -h) usage; exit 0 ;;
*) say "test.sh: unknown option '$1' (see --help)"; exit 2 ;;
esac

start=$SECONDS
install_packages build test || exit $?

summary=()
status=0
# test_preset NAME CTEST-ARGUMENT...: builds, tests, and adds a line to the summary
test_preset() {
    local preset=$1 log=build/$1-ctest.log begun=$SECONDS verdict
    shift
    if ! build_preset "$preset"; then
        summary+=("$preset: does not build")
        status=1
        return
    fi
    # Two at a time: tests pass beside two busy processes, and most wait for one thread of a driver.
    if ctest --test-dir "build/$preset" -j2 --output-on-failure --no-tests=error "$@" \
        </dev/null 2>&1 | tee "$log"; then
        verdict=passed
    else
        verdict=FAILED
        status=1
    fi
    verdict="$verdict: $(grep -E 'tests passed' "$log" || echo 'no test ran'), $(since "$begun")"
    summary+=("$preset: $verdict")
}

test_preset dev -L '^(unit|shader|golden)$' -LE slow
test_preset asan -L '^unit$' -LE slow

echo
echo "Summary (${CI:+CI, }$(nproc) cores, $(since "$start") in all)"
printf '  %s\n' "${summary[@]}"
exit "$status"
