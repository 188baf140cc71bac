#!/usr/bin/env bash
# nightly_test.sh FRAGMARK: two nights and what they leave; one that is killed and goes on; one that
# its time cuts off; a night that is worse than its baseline; history and baseline as commands; nights
# whose plan or code changed under them; two within one second.
set -euo pipefail
program=$(realpath "${1:?usage: nightly_test.sh FRAGMARK}")
report=$(dirname "$program")/fragmark-report
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "nightly_test: $*" >&2
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

nightly() { "$program" nightly policy.yml; }
ends() { grep -c '"event":"end"' "$1/run/journal.jsonl"; }

# kill_nightly POLICY ROOT COUNT: begins a night in ROOT and kills it, with what it started left alone,
# while it measures, once COUNT launches ended; its folder is then $killed
kill_nightly() {
    local before nightly_id
    before=$(readlink "$2/latest" || true)
    "$program" nightly "$1" >log 2>&1 &
    nightly_id=$!
    for _ in $(seq 3000); do # a busy machine needs its time
        kill -0 "$nightly_id" 2>/dev/null || fail "it ended before it was killed: $(tail -3 log)"
        killed=$2/$(readlink "$2/latest" || true)
        [ "$killed" != "$2/$before" ] && [ -f "$killed/run/journal.jsonl" ] && [ "$(ends "$killed")" -ge "$3" ] &&
            grep -q '"stage": "measures"' "$killed/nightly.json" && break
        sleep 0.1
    done
    kill -9 "$nightly_id"
    wait "$nightly_id" 2>/dev/null || true
    grep -q '"stage": "measures"' "$killed/nightly.json" || fail "it was not killed while it measured"
}

cat >policy.yml <<'EOF'
methods: [kplus-array, ab-ll]
axes: ["width_px=64", "height_px=48", "n=8", "k=4", "frames=2", "warmup=1"]
budget_minutes: 9
launches_least: 2
launches_most: 4
baseline: good
output: nights
state: state
EOF

# The first night: all files are there, and nothing is an alarm.
expect 0 "no baseline 'good'" nightly
first=$(realpath nights/latest)
for file in summary.md junit.xml night.json history.html nightly.json run/report.html run/summary.csv; do
    [ -s "$first/$file" ] || fail "$first has no $file"
done
grep -q "nightly: quiet" "$first/summary.md" || fail "the first night is not quiet"
[ "$(grep -c "<testcase" "$first/junit.xml")" = 2 ] || fail "junit.xml has not two cases"
[ "$(ends "$first")" = 8 ] || fail "not 4 launches of 2 cases: $(ends "$first")"
grep -q '"cases": 2' "$first/nightly.json" || fail "nightly.json does not tell 2 cases"

# The second night is another entry, and knows the first.
expect 0 "summary.md" nightly
[ "$(realpath nights/latest)" != "$first" ] || fail "the second night is the first"
expect 0 "started" "$program" history list --state state
[ "$(wc -l <said)" = 3 ] || fail "not two runs in the history"
expect 0 "no alarm yet: 1 nights before this one" "$program" history show kplus-array --state state
expect 0 '"launches": 4' "$program" history show kplus-array --state state --json
expect 0 "page.html" "$program" history page -o page.html --state state
[ "$(grep -o "<svg class=spark" page.html | wc -l)" = 2 ] || fail "not two sparklines"

# Killed, with what it started left alone: it goes on in the same folder, and measures no launch twice.
sed -i 's/launches_least: 2/launches_least: 15/; s/launches_most: 4/launches_most: 15/' policy.yml
kill_nightly policy.yml nights 5
before=$(ends "$killed")
expect 0 "continues $killed" nightly
[ "nights/$(readlink nights/latest)" = "$killed" ] || fail "another night was begun"
[ "$before" -lt 30 ] || fail "it was killed too late to say anything"
[ "$(ends "$killed")" = 30 ] || fail "$(ends "$killed") launches were measured, not 30"
grep -q '"stage": "done"' "$killed/nightly.json" || fail "it is not done"

# A time that is too short cuts the launches off; what is there is judged.
sed -i 's/launches_least: 15/launches_least: 900/; s/launches_most: 15/launches_most: 1000/' policy.yml
sed -i 's/methods: .*/methods: [kplus-array]/; s/budget_minutes: 9/budget_minutes: 0.3/' policy.yml
expect 0 "summary.md" nightly
grep -q "the time was over before all of them were" nights/latest/summary.md || fail "it was not cut off"

# Exactly worse than the baseline: four bytes more.
sed -i 's/launches_least: 900/launches_least: 2/; s/launches_most: 1000/launches_most: 2/' policy.yml
sed -i 's/budget_minutes: 0.3/budget_minutes: 9/' policy.yml
cp -r nights/latest/run better
bytes=$("$program" history show kplus-array --state state --json | grep -o '"bytes_allocated": [0-9]*' |
    tail -1 | grep -o '[0-9]*$')
sed -i "s/,$bytes,/,$((bytes - 4)),/g" better/summary.csv
expect 0 "state/baselines/good/" "$program" baseline set good better --state state
rm -r better # it is a copy

expect 1 "memory: " nightly
grep -q "nightly: ALARM" nights/latest/summary.md || fail "summary.md has no alarm"
grep -q "since baseline good" nights/latest/summary.md || fail "summary.md does not name the baseline"
grep -q '<failure type="memory"' nights/latest/junit.xml || fail "junit.xml has no failure"
expect 0 "bytes_allocated" "$program" compare baseline:good nights/latest/run --state state
expect 2 "the nearest is 'good'" "$program" compare baseline:god nights/latest/run --state state
expect 0 "unchanged since" "$program" baseline show good --state state
echo >>"$(find state/baselines -name summary.csv)"
expect 8 "changed since the baseline was set" "$program" baseline show good --state state
expect 8 "changed since the baseline was set" "$program" compare baseline:good nights/latest/run --state state
rm -r state/baselines

# A night that is not the last is judged by those before it.
expect 0 "again/summary.md" "$report" night "$killed/run" -o again --state state
grep -q "2 later runs of these cases" again/summary.md || fail "later nights are not told: $(cat again/summary.md)"

# A spec that changed between is another plan, a shader that changed is other code: the night is given
# up, and another one begun, by the same command.
cat >changing.yml <<'EOF'
spec: plan.yml
plugin_dirs: [mine]
budget_minutes: 9
launches_least: 8
launches_most: 8
output: changing
state: changing-state
EOF
mkdir mine
cp -rL "$(dirname "$program")/methods/kplus-array" mine/
plan() { echo "{ methods: [kplus-array], scenes: [layers], width_px: 64, height_px: 48, n: 8, k: [$1], frames: 2, warmup: 1 }" >plan.yml; }
plan 4
kill_nightly changing.yml changing 3
plan 2
expect 0 "continues $killed" "$program" nightly changing.yml
grep -q "begins changing/" said || fail "no other night was begun: $(cat said)"
grep -q '"stage": "given-up"' "$killed/nightly.json" || fail "a night of another plan was not given up"
[ "$(ends changing/latest)" = 8 ] || fail "not all of the other plan was measured"
kill_nightly changing.yml changing 3
echo "// other code" >>mine/kplus-array/resolve.glsl
expect 0 "continues $killed" "$program" nightly changing.yml
grep -q "begins changing/" said || fail "no other night was begun: $(cat said)"
grep -q '"stage": "given-up"' "$killed/nightly.json" || fail "a night of other code was not given up"
[ "$(ends changing/latest)" = 8 ] || fail "not all was measured by the other code"
[ "$(find changing -name nightly.json | wc -l)" = 4 ] || fail "not four nights"

# Nights whose second, and those after it, have a folder: each has one of its own, in their order.
sed -i 's/launches_least: 8/launches_least: 1/; s/launches_most: 8/launches_most: 1/; s/: changing/: crowded/' changing.yml
now=$(date +%s)
for i in $(seq 0 40); do
    mkdir -p "crowded/$(date -u -d "@$((now + i))" +%Y%m%dT%H%M%SZ)"
done
taken=$(find crowded -mindepth 1 -printf '%f\n' | sort | tail -1)
expect 0 "begins crowded/" "$program" nightly changing.yml
one=$(readlink crowded/latest)
expect 0 "begins crowded/" "$program" nightly changing.yml
two=$(readlink crowded/latest)
[[ "$taken" < "$one" && "$one" < "$two" ]] || fail "nights are $one and $two after $taken"
expect 0 "started" "$program" history list --state crowded-state
[ "$(wc -l <said)" = 3 ] || fail "not two runs in the history: $(cat said)"

# What is wrong is told.
expect 2 "no such file" env LC_ALL=C bash -c "'$program' nightly none.yml 2>&1 | tr A-Z a-z; exit \${PIPESTATUS[0]}"
echo "methds: [kb]" >wrong.yml
expect 2 "methods" "$program" nightly wrong.yml
echo "launches_least: 5000" >wrong.yml
expect 2 "wrong.yml:1" "$program" nightly wrong.yml
echo "methods: [kplus-aray]" >wrong.yml
expect 2 "kplus-array" "$program" nightly wrong.yml -o elsewhere
[ -z "$(ls elsewhere)" ] || fail "a policy that cannot be planned left a night"
expect 2 "no history yet" "$program" history list --state empty
expect 2 "the nearest is 'show'" "$program" history shwo --state state
expect 2 "the nearest is 'kplus-array'" "$program" history show kplus-aray --state state
echo "no database, and longer than a few bytes" >state/history.sqlite
expect 8 "no history of fragmark" "$program" history list --state state

expect 8 "no history of fragmark" nightly
echo "nightly_test: ok"
