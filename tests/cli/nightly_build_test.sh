#!/usr/bin/env bash
# nightly_build_test.sh FRAGMARK: nights that build first, on the dummy device: the build comes before plugins are read,
# its time and its failure are told, one that is killed is done again, and a program that built itself anew goes on.
set -euo pipefail
program=$(realpath "${1:?usage: nightly_build_test.sh FRAGMARK}")
methods=$(dirname "$program")/methods
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
mkdir "$work/policies"
cd "$work"

fail() {
    echo "nightly_build_test: $*" >&2
    exit 1
}

# expect CODE WORDS COMMAND...: it ends with CODE and says WORDS
expect() {
    local wanted=$1 words=$2 code=0
    shift 2
    "$@" >said 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { cat said >&2; fail "$*: ended with $code, not $wanted"; }
    grep -qF -- "$words" said || { cat said >&2; fail "$*: does not say '$words'"; }
}

# policy BUILD [MINUTES [METHOD]]
policy() {
    cat >policies/policy.yml <<EOF
methods: [${3:-kplus-array}]
devices: [dummy]
axes: ["width_px=16", "height_px=12", "n=4", "k=2", "frames=2", "warmup=0"]
budget_minutes: ${2:-5}
launches_least: 2
launches_most: 2
plugin_dirs: [made]
build: $1
output: nights
state: state
EOF
}
nightly() { "$program" nightly policies/policy.yml; }
nights() { ls policies/nights | grep -c '^2'; }
latest=policies/nights/latest

# The plugin is not there before the build, which works in the policy's folder and gets its words as they are.
cat >policies/build.sh <<EOF
#!/bin/sh
echo "builds \$1 in \$(pwd)"
mkdir -p made
cp -rL "$methods/kplus-array" made/kplus-array
[ -e fails ] && { echo "it cannot be built"; exit 9; }
exit 0
EOF
chmod +x policies/build.sh
policy '[./build.sh, "two words; $HOME"]'
expect 0 "2 launches of each case" nightly
grep -qF "builds two words; \$HOME in $work/policies" $latest/build.log || fail "build.log: $(cat $latest/build.log)"
grep -q "Built in [0-9]* s by \`./build.sh 'two words; \$HOME'\`" $latest/summary.md || fail "summary.md: $(cat $latest/summary.md)"
grep -q '"stage": "done"' $latest/nightly.json || fail "it is not done"
grep -q '"built_s": [0-9.]*[1-9]' $latest/nightly.json || fail "its time is not told: $(cat $latest/nightly.json)"
grep -q "$work/policies/made" $latest/run/manifest.json || grep -q '"kplus-array.so"' $latest/run/manifest.json || fail "what was built was not measured"

# A build that fails ends the night, which the next one does not continue.
touch policies/fails
expect 3 "not built, and nothing measured" nightly
grep -q "ended with 9 after" $latest/summary.md || fail "summary.md: $(cat $latest/summary.md)"
grep -q "^    it cannot be built" $latest/summary.md || fail "summary.md has no log: $(cat $latest/summary.md)"
grep -q '"stage": "given-up"' $latest/nightly.json || fail "a night that was not built is not given up"
[ ! -e $latest/run ] || fail "something was measured"
rm policies/fails
count=$(nights)
expect 0 "begins" nightly
[ "$(nights)" = $((count + 1)) ] || fail "the next night is no night of its own"

# Too long: half of the budget, and what it started ends with it.
policy "[sh, -c, 'sleep 61.731 & sleep 62.731']" 0.1
expect 3 "did not end within 3 s" nightly
sleep 0.5
! pgrep -f 'sleep 6[12]\.731$' >/dev/null || fail "the build goes on"

# Commands that are not there leave no night.
count=$(nights)
policy '[no-such-builder]'
expect 2 "'no-such-builder' is no program in PATH" nightly
policy '[./none.sh]'
expect 2 "'./none.sh' is no program that can be executed" nightly
policy '[]'
expect 2 "build: a command and its arguments" nightly
[ "$(nights)" = "$count" ] || fail "a command that is not there left a night"
# A plan that cannot be, once it is built, is given up.
policy '[true]' 5 kplus-aray
expect 2 "kplus-array" nightly
grep -q '"stage": "given-up"' $latest/nightly.json || fail "a night without a plan is not given up"

# Killed while it builds: it builds again, in the same night.
policy "[sh, -c, 'echo once >>builds; [ -e go ] || exec sleep 60']"
"$program" nightly policies/policy.yml >log 2>&1 &
nightly_id=$!
for _ in $(seq 3000); do
    [ -e policies/builds ] && grep -q '"stage": "builds"' $latest/nightly.json && break
    kill -0 "$nightly_id" 2>/dev/null || fail "it ended before it was killed: $(tail -3 log)"
    sleep 0.1
done
kill -9 "$nightly_id"
wait "$nightly_id" 2>/dev/null || true
killed=$(realpath $latest)
touch policies/go
expect 0 "continues policies/nights/$(basename "$killed")" nightly
[ "$(realpath $latest)" = "$killed" ] || fail "another night was begun"
[ "$(wc -l <policies/builds)" = 2 ] || fail "it did not build again"

# It builds the program that is at work: the new one goes on.
mkdir mine
cp "$program" "$(dirname "$program")/fragmark-report" mine/
policy "[cp, --remove-destination, \"$program\", \"$work/mine/fragmark\"]"
expect 0 "the new one goes on" mine/fragmark nightly policies/policy.yml
grep -qF "continues policies/nights/" said || fail "the new program begins another night: $(cat said)"
grep -qF "\"program\": \"$work/mine/fragmark\"" $latest/run/manifest.json || fail "the old program has measured"
echo "nightly_build_test: ok"
