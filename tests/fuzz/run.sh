#!/usr/bin/env bash
# run.sh [-b BUILD] SECONDS [TARGET]...: runs the fuzz targets of a build (build/fuzz if it is there, with
# libFuzzer; else build/asan) for SECONDS each, all of them if none is named, and prints a table of
# counts. Exit code 1: a finding; the input is in BUILD/tests/fuzz/findings.
# What libFuzzer found worth keeping stays in BUILD/tests/fuzz/grown, for the next time.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
source=$here/../..
build=$source/build/fuzz
[ -d "$build/tests/fuzz" ] || build=$source/build/asan
if [ "${1:-}" = -b ]; then
    build=$2
    shift 2
fi
seconds=${1:?usage: run.sh [-b BUILD] SECONDS [TARGET]...}
shift
targets=("$@")
[ ${#targets[@]} -gt 0 ] || mapfile -t targets < <(ls "$here/corpus")

folder=$build/tests/fuzz
suppressions=$here/../suppressions
export ASAN_OPTIONS=suppressions=$suppressions/asan.txt:detect_leaks=1
export LSAN_OPTIONS=suppressions=$suppressions/lsan.txt:print_suppressions=0
export UBSAN_OPTIONS=print_stacktrace=1
mkdir -p "$folder/findings" "$folder/grown"
status=0

# fuzz TARGET: runs it, and prints how many inputs it ran
fuzz() {
    local program=$folder/fuzz_$1 log=$folder/$1.log seed=$RANDOM
    if grep -q libFuzzer "$program"; then
        mkdir -p "$folder/grown/$1"
        "$program" -max_total_time="$seconds" -seed="$seed" -timeout=10 -rss_limit_mb=4096 -print_final_stats=1 \
            -artifact_prefix="$folder/findings/$1-" "$folder/grown/$1" "$here/corpus/$1" >"$log" 2>&1 || return 1
        grep -o 'number_of_executed_units: [0-9]*' "$log" | grep -o '[0-9]*'
    else
        local last=$folder/findings/$1-$seed
        "$program" "$here/corpus/$1" "$seconds" "$seed" "$last" >"$log" 2>&1 || return 1
        rm -f "$last"
        grep -o '^[0-9]*' "$log"
    fi
}

printf '%-10s %12s  %s\n' target inputs finding
for target in "${targets[@]}"; do
    if count=$(fuzz "$target"); then
        printf '%-10s %12s  %s\n' "$target" "$count" none
    else
        printf '%-10s %12s  %s\n' "$target" - "see $folder/$target.log"
        status=1
    fi
done
exit $status
