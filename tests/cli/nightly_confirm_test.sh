#!/usr/bin/env bash
# nightly_confirm_test.sh FRAGMARK [vulkan]: nights whose alarm on time is held against a base. The nights before are
# copies of the first one, whose times are a tenth. On the dummy device an equal base dismisses the alarm, one that
# needs less memory confirms it, a killed confirmation goes on, and without base or time the alarm stands. With
# `vulkan`, on a software rasteriser, a plugin that was made slower is confirmed by times, and an equal one is not.
set -euo pipefail
program=$(realpath "${1:?usage: nightly_confirm_test.sh FRAGMARK [vulkan]}")
device=${2:-dummy}
methods=$(dirname "$program")/methods
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"

fail() {
    echo "nightly_confirm_test: $*" >&2
    exit 1
}

# expect CODE WORDS COMMAND...: it ends with CODE and says WORDS
expect() {
    local wanted=$1 words=$2 code=0
    shift 2
    "$@" >said 2>&1 || code=$?
    [ "$code" = "$wanted" ] || { cat said >&2; tail -5 nights/latest/*.log >&2; fail "$*: ended with $code, not $wanted"; }
    grep -qF -- "$words" said || { cat said >&2; fail "$*: does not say '$words'"; }
}
nightly() { "$program" nightly policy.yml; }
latest=nights/latest
in_summary() { grep -qF -- "$1" $latest/summary.md || fail "'$1' is not in summary.md: $(cat $latest/summary.md)"; }
ends() { cat "$1/journal.jsonl" 2>/dev/null | grep -c '"event":"end"' || true; }

size='"width_px=16", "height_px=12", "n=4", "k=2", "frames=2", "warmup=0"'
if [ "$device" = vulkan ]; then
    "$program" doctor 2>&1 | grep -qi 'llvmpipe' || { echo "nightly_confirm_test: no lavapipe here"; exit 77; }
    size='"width_px=214", "height_px=120", "n=16", "k=4"'
fi
cat >policy.yml <<EOF
methods: [kplus-heap]
devices: [$device]
axes: [$size]
budget_minutes: 30
launches_least: 2
launches_most: 4
plugin_dirs: [plugins]
output: nights
state: state
EOF
mkdir plugins base
cp -rL "$methods/kplus-heap" plugins/
cp -rL "$methods/kplus-heap" base/
if [ "$device" = vulkan ]; then
    # Some 2000 multiplications a pixel, whose result nobody can know to be of no use.
    cat >plugins/kplus-heap/clear.glsl <<'GLSL'
void clear(uvec2 pixel)
{
    uint x = pixel.x;
    FM_LOOP for (uint i = 0u; i < 2000u; i++)
        x = x * 1664525u + 1013904223u;
    counters[fm_pixel_index(pixel)] = x == 0xFFFFFFFFu && pixel.y == 0x7FFFFFFFu ? 1u : 0u;
}
GLSL
fi

# invent NIGHT: the run of the latest night as one of so many days ago, in a tenth of its time
invent() {
    local started column
    started=$(date -u -d "-$1 days" +%Y-%m-%dT%H:%M:%SZ)
    cp -r $latest/run invented
    sed -i "s/\"run_id\": \"[^\"]*\"/\"run_id\": \"invented-$1\"/; s/\"started\": \"[^\"]*\"/\"started\": \"$started\"/" invented/manifest.json
    awk -F, -v OFS=, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i }
        NR > 1 && $at["metric"] == "frame_ms" { $at["value"] = $at["value"] * (0.1 + 0.0001 * '"$1"') } { print }' \
        $latest/run/samples.csv >invented/samples.csv
    "$program" history add invented --state state >/dev/null
    rm -r invented
}

# Three nights like the first make an alarm, after many that were faster.
expect 0 "summary.md" nightly
for night in $(seq 2 27); do invent "$night"; done
expect 0 "summary.md" nightly
cp -r state saved

again() { rm -r state; cp -r saved state; }

# Nobody confirms.
expect 1 "slower: " nightly
in_summary "Findings on time are unconfirmed. With \`base: DIR\` in the policy"
grep -q '"gate": "none"' $latest/nightly.json || fail "a gate was asked"
[ ! -e $latest/gate ] || fail "a gate has measured"

if [ "$device" = vulkan ]; then
    again
    echo "base: base" >>policy.yml
    expect 1 "slower, confirmed: " nightly
    in_summary "slower, confirmed"
    in_summary "; a gate says worse"
    again
    cp plugins/kplus-heap/clear.glsl base/kplus-heap/
    expect 0 "slower, not confirmed: " nightly
    in_summary "nightly: quiet"
    echo "nightly_confirm_test: ok"
    exit
fi

# An equal base: it is no alarm.
again
echo "base: base" >>policy.yml
expect 0 "slower, not confirmed: " nightly
in_summary "nightly: quiet"
in_summary "; a gate says "
grep -q '"gate": "answered"' $latest/nightly.json || fail "nightly.json does not tell of the gate"
grep -q '"dismissed": true' $latest/night.json || fail "night.json does not tell of it"
! grep -q "<failure" $latest/junit.xml || fail "junit.xml has a failure"
[ "$(ends $latest/gate/base)" = "$(ends $latest/gate/new)" ] || fail "not as many launches on both sides"
[ "$(tail -n +2 $latest/gate/ab.csv | wc -l)" = 1 ] || fail "not one case: $(cat $latest/gate/ab.csv)"

# Killed in the confirmation, with what it started left alone: it goes on.
again
"$program" nightly policy.yml >log 2>&1 &
nightly_id=$!
for _ in $(seq 6000); do
    [ "$(ends $latest/gate/new)" -ge 3 ] && grep -q '"stage": "confirms"' $latest/nightly.json && break
    kill -0 "$nightly_id" 2>/dev/null || fail "it ended before it was killed: $(tail -3 log)"
    sleep 0.02
done
kill -9 "$nightly_id"
wait "$nightly_id" 2>/dev/null || true
killed=$(realpath $latest)
grep -q '"stage": "confirms"' "$killed/nightly.json" || fail "it was not killed while it confirmed"
expect 0 "continues nights/$(basename "$killed")" nightly
[ "$(realpath $latest)" = "$killed" ] || fail "another night was begun"
in_summary "slower, not confirmed"
for side in base new; do
    twice=$(grep '"event":"end"' "$killed/gate/$side/journal.jsonl" | sed 's/.*"launch":\([0-9]*\).*/\1/' | sort | uniq -d)
    [ -z "$twice" ] || fail "$side: launches $twice were measured twice"
done

# A base whose program says that it needs less memory: it is measured by that program, and the alarm is confirmed.
again
mkdir -p build/methods
cp -rL "$methods/kplus-heap" "$methods/kplus-array" "$methods/common" build/methods/
cat >build/fragmark <<END
#!/bin/sh
[ "\$1" = worker ] || exec "$program" "\$@"
"$program" "\$@" || exit
sed -i 's/"bytes_allocated": [0-9]*/"bytes_allocated": 8/' "\$3"
END
chmod +x build/fragmark
sed -i 's/^base: .*/base: build/' policy.yml
expect 1 "slower, confirmed: " nightly
in_summary "nightly: ALARM"
in_summary "; a gate says worse: bytes_allocated 8 -> "
grep -q '<failure type="slower"' $latest/junit.xml || fail "junit.xml has no failure"
! grep -q "unconfirmed" $latest/summary.md || fail "summary.md calls it unconfirmed"

# No time is left, no base is there, or it does not have the method: the alarm stands, and the summary says why.
again
sed -i 's/^budget_minutes: .*/budget_minutes: 0.3/' policy.yml
expect 1 "slower: " nightly
in_summary "no time was left of the budget"
grep -q '"gate": "no-time"' $latest/nightly.json || fail "nightly.json does not tell of the time"
sed -i 's/^budget_minutes: .*/budget_minutes: 30/; s/^base: .*/base: none/' policy.yml
again
expect 1 "what is slower cannot be confirmed: " nightly
in_summary "the gate could not measure"
again
mkdir -p other/ab-ll
cp -rL "$methods/ab-ll" other/
sed -i 's/^base: .*/base: other/' policy.yml
expect 1 "the base has none of the methods" nightly
# So it is with a program of another version.
again
printf '#!/bin/sh\nexit 2\n' >build/fragmark
sed -i 's/^base: .*/base: build/' policy.yml
expect 1 "slower: " nightly
grep -q "does not answer" $latest/gate.log || fail "gate.log: $(cat $latest/gate.log)"
grep -q '"gate": "failed"' $latest/nightly.json || fail "nightly.json does not tell that the gate failed"
echo "nightly_confirm_test: ok"
