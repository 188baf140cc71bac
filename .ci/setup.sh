# Set-up shared by reproduce.sh and test.sh; sourced, from the repository root.
# shellcheck shell=bash

say() { printf '%s\n' "$*" >&2; }

# seconds since the given $SECONDS value, as "1 min 05 s"
since() {
    local s=$((SECONDS - $1))
    printf '%d min %02d s' $((s / 60)) $((s % 60))
}

# packages_of SECTION...: the names in these sections of packages.txt
packages_of() {
    local section='' line wanted=" $* "
    while IFS= read -r line || [ -n "$line" ]; do
        line=${line%%#*}
        line=${line//[[:space:]]/}
        case $line in
        '') ;;
        \[*\]) section=${line//[\[\]]/} ;;
        *) case $wanted in *" $section "*) printf '%s\n' "$line" ;; esac ;;
        esac
    done <packages.txt
}

# packages_missing SECTION...: those that dpkg does not have installed
packages_missing() {
    local name
    for name in $(packages_of "$@"); do
        [ "$(dpkg-query -W -f '${db:Status-Status}' "$name" 2>/dev/null)" = installed ] ||
            printf '%s\n' "$name"
    done
}

# as_root COMMAND...: runs it as root, or says what an administrator must run and returns 2
as_root() {
    if [ "$(id -u)" -eq 0 ]; then
        "$@" </dev/null
    elif command -v sudo >/dev/null && sudo -n true 2>/dev/null; then
        sudo -n "$@" </dev/null
    elif command -v sudo >/dev/null && [ -t 0 ] && [ -z "${CI:-}" ]; then
        sudo "$@"
    else
        return 2
    fi
}

# install_packages SECTION...: installs what is missing and prints how long that took
install_packages() {
    local start=$SECONDS missing status=0
    if ! command -v dpkg-query >/dev/null; then
        say "set-up: no dpkg here; install what packages.txt lists by your system's own names"
        return 0
    fi
    # Names hold no blanks; and no <( ) here, which needs a /dev/fd that bare systems lack.
    # shellcheck disable=SC2207
    missing=($(packages_missing "$@"))
    if [ "${#missing[@]}" -eq 0 ]; then
        say "set-up: all packages are installed"
        return 0
    fi
    say "set-up: installing ${#missing[@]} packages: ${missing[*]}"
    as_root apt-get update -q >&2 &&
        as_root env DEBIAN_FRONTEND=noninteractive \
            apt-get install -q -y --no-install-recommends "${missing[@]}" >&2 || status=$?
    if [ "$status" -ne 0 ]; then
        # shellcheck disable=SC2207
        missing=($(packages_missing "$@"))
        say "set-up: could not install the packages; as an administrator run:"
        say "  apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
        return 2
    fi
    say "set-up: packages took $(since "$start")"
}

# build_preset NAME: configures and builds build/NAME with all cores and prints how long that took.
# The compiler's output goes to build/NAME.log and is shown when something fails.
build_preset() {
    local start=$SECONDS log=build/$1.log
    mkdir -p build
    say "build: preset $1 (output in $log)"
    if ! { cmake --preset "$1" && cmake --build --preset "$1"; } >"$log" 2>&1 </dev/null; then
        tail -n 60 "$log" >&2
        say "build: preset $1 failed; all output is in $log"
        return 1
    fi
    say "build: preset $1 took $(since "$start")"
}
