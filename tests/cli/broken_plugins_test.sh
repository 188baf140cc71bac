#!/usr/bin/env bash
# broken_plugins_test.sh PROGRAM HOSTILE: plugins that crash, hang, print, fork or are no plugins lie on
# the path. They are listed with their reasons, cost a healthy method nothing, print nothing of their
# own and leave nothing running. HOSTILE: the folder of those that are built (tests/plugins/hostile.c).
set -euo pipefail
program=$1 hostile=$2
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
failed=0
export XDG_CACHE_HOME=$temporary/cache
unset FRAGMARK_CACHE
. "$(dirname "$0")/nothing_left.sh"

fail() {
    echo "FAILED: $*"
    failed=1
}

# Sanitizers take that signal and exit; they have no limit on memory, and so no plugin that eats it.
segv='killed by SIGSEGV'
[ -d "$hostile/eats" ] || segv='ended the process, status 1'

# Plugins that no compiler made.
files=$temporary/files
mkdir -p "$files"/{empty,text,folder,pipe,cut,dangling,device,wild-name}
: >"$files/empty/empty.so"
echo "a text" >"$files/text/text.so"
mkdir "$files/folder/folder.so"
mkfifo "$files/pipe/pipe.so"
head -c 5000 "$hostile/prints/prints.so" >"$files/cut/cut.so"
ln -s /nowhere.so "$files/dangling/dangling.so"
ln -s /dev/zero "$files/device/device.so"
cp "$hostile/prints/prints.so" "$files/wild-name/wild-name.so"

expect_line() { # FILE PATTERN
    grep -qE -- "$2" "$1" || fail "no line '$2' in $(basename "$1"): $(grep -- "${3:-.}" "$1" | head -c 3000)"
}

methods=${FRAGMARK_PLUGIN_PATH:?}
export FRAGMARK_PLUGIN_PATH=$files:$hostile:$methods
small=(-q --no-report --no-images -a launches=1 -a frames=1 -a warmup=0 -a width_px=16 -a height_px=12 -a n=4 -a k=2)

# A method that is named is all that is read.
started=$(date +%s)
code=0
"$program" run "${small[@]}" --method kplus-array -o "$temporary/run" \
    >"$temporary/run.out" 2>"$temporary/run.err" || code=$?
[ "$code" = 0 ] || fail "run beside broken plugins: exit $code: $(cat "$temporary/run.err")"
[ ! -s "$temporary/run.out" ] || fail "run printed: $(cat "$temporary/run.out")"
! grep -q HOSTILE "$temporary/run.err" || fail "run passed on what a plugin printed"
expect_line "$temporary/run/summary.csv" ',ok,'
expect_nothing_left run

# All are read, and told.
code=0
"$program" list methods >"$temporary/list" 2>"$temporary/list.err" || code=$?
[ "$code" = 0 ] || fail "list: exit $code"
[ ! -s "$temporary/list.err" ] || fail "list said: $(cat "$temporary/list.err")"
! grep -q 'HOSTILE OUTPUT' "$temporary/list" || fail "list passed on what a plugin printed"
expect_nothing_left list
refused=0
while read -r id reason; do
    refused=$((refused + 1))
    expect_line "$temporary/list" "^$id +refused: $id\.so: .*${reason/SEGV/$segv}" "^$id "
done <<'END'
empty cannot be loaded
text cannot be loaded
folder it is a folder
pipe it is a pipe
cut (cannot be loaded|killed by SIG|status)
device it is a device
wild-name named 'prints.so'
exits ended the process, status 0
crashes SEGV
spins (2 s of processor time|no end after)
sleeps no end after 5 s
stops no end after 5 s
prints-on (2 s of processor time|no end after)
raises-limits (2 s of processor time|killed by SIGKILL|no end after)
kills-parent ended the process that watched it
kills-group killed by SIGKILL
fills-disk (2 s of processor time|no end after)
wild-text descriptor was read.*SEGV
huge-size size_bytes: the plugin has 4294967295
other-abi abi: the plugin has 4
zeros abi: the plugin has 0
END
[ ! -d "$hostile/eats" ] || expect_line "$temporary/list" '^eats +refused: eats\.so: .*(killed by SIG|2 s of processor|no end after)'
expect_line "$temporary/list" '^dangling +refused: .*No such file'
for id in prints daemonises forks closes kplus-array; do # these are good, whatever else they do
    expect_line "$temporary/list" "^$id +[^r]" "^$id "
done

# From here on without those that take their time.
few=$temporary/few
mkdir "$few"
for id in crashes exits prints zeros; do
    ln -s "$hostile/$id" "$few/$id"
done
ln -s "$files/pipe" "$few/pipe"
export FRAGMARK_PLUGIN_PATH=$few:$methods

# The doctor tells them, too.
"$program" doctor >"$temporary/doctor" 2>&1 || true
expect_line "$temporary/doctor" "refused: crashes\.so: .*$segv"
expect_nothing_left doctor

# Named: refused with the reason, and nothing runs. Beside a healthy method: a row that says so.
code=0
"$program" run "${small[@]}" --method crashes -o "$temporary/named" >/dev/null 2>"$temporary/named.err" || code=$?
[ "$code" = 2 ] || fail "run --method crashes: exit $code"
expect_line "$temporary/named.err" "method 'crashes' is refused: crashes\.so: .*$segv"
[ ! -e "$temporary/named" ] || fail "a refused method left a folder of results"
code=0
"$program" run "${small[@]}" --method zeros,kplus-array -o "$temporary/both" >/dev/null 2>&1 || code=$?
[ "$code" = 4 ] || fail "run --method zeros,kplus-array: exit $code"
expect_line "$temporary/both/summary.csv" 'plugin_error.*zeros\.so: abi: the plugin has 0'
code=0
"$program" plan -q --method zeros,kplus-array -a pag=2 >/dev/null 2>"$temporary/option.err" || code=$?
[ "$code" = 2 ] || fail "an option beside a refused method: exit $code"
expect_line "$temporary/option.err" "no key 'pag', and method 'zeros' is refused"

# All: each that is left out has a line.
"$program" plan -q -a k=2 >"$temporary/plan" 2>"$temporary/plan.err"
expect_line "$temporary/plan.err" "left out: method 'exits' is refused"
! grep -q ' exits ' "$temporary/plan" || fail "a refused method is a case of all"
expect_line "$temporary/plan" 'kplus-array'
expect_nothing_left plan

# A cache that is damaged, foreign, a folder, or nowhere changes nothing.
for file in "$XDG_CACHE_HOME"/fragmark/plugins/*; do
    head -c 3000 /dev/urandom >"$file"
done
"$program" list methods --json >"$temporary/json" 2>&1
grep -q '"crashes"' "$temporary/json" || fail "list with a damaged cache"
export FRAGMARK_PLUGIN_PATH=$methods
good=$("$program" list methods)
for cache in /proc/nowhere "$temporary/plan" ""; do
    [ "$(XDG_CACHE_HOME=$cache HOME=/nonexistent "$program" list methods 2>&1)" = "$good" ] ||
        fail "list with the cache at '$cache'"
done
truncate -s 100 "$XDG_CACHE_HOME"/fragmark/plugins/*
[ "$("$program" list methods 2>&1)" = "$good" ] || fail "list with a cache that was cut"
[ "$("$program" list methods 2>&1)" = "$good" ] || fail "list from the cache"

echo "$refused broken plugins, $(($(date +%s) - started)) s"
exit "$failed"
