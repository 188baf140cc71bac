#!/usr/bin/env bash
# faulty_plugins_test.sh PROGRAM FAULTY: plugins that are good until a hook of theirs is called, or a shader
# runs (FAULTY: tests/plugins/hostile.c, hostile-technique.c and slower.c). Each runs with a good method
# beside it. Its own row, or the run's message, says what it did in which hook; the good one's row is what it
# is without it; nothing keeps running, no file is left; and the run ends in time.
set -euo pipefail
program=$1 faulty=$2
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
failed=0
export XDG_CACHE_HOME=$temporary/cache
unset FRAGMARK_CACHE
fail() {
    echo "FAILED: $*" >&2
    failed=1
}
. "$(dirname "$0")/nothing_left.sh"

export FRAGMARK_PLUGIN_PATH=$faulty:${FRAGMARK_PLUGIN_PATH:?}
timeout_s=3
[ -d "$faulty/eats" ] || timeout_s=10 # sanitizers take their time
any=(-q --no-report --no-images --timeout "$timeout_s" -a launches=1)
small=(-a frames=2 -a warmup=0 -a width_px=16 -a height_px=12 -a n=4 -a k=2 -a pixel_density=1)
declare -A arguments=(
    [dummy]="--device dummy"
    [vulkan]="--device vulkan"
    [tbr]="--device tbr --scene frames/puzzle-static-1 -a width_px=64 -a height_px=64 -a sequence_frames=3")
declare -A good=([dummy]=kplus-array [vulkan]=kplus-array [tbr]=tbr-base)
crashed='(killed by SIG(SEGV|ABRT|FPE)|exited with status [0-9]+ and left no result), '

# run DEVICE METHODS DIR [ARGUMENT...]
run() {
    local device=$1 methods=$2 directory=$3 words
    shift 3
    read -ra words <<<"${arguments[$device]}"
    [ "$device" = tbr ] || words+=("${small[@]}")
    "$program" run "${any[@]}" "${words[@]}" "$@" --method "$methods" -o "$directory"
}

# The row of the good method, but for what differs from run to run: on the dummy device clocks stand still.
row_of_good() { # DIR DEVICE
    local fields=1-22
    [ "$2" != dummy ] || fields=1-30
    grep -E ",${good[$2]}," "$1/summary.csv" | cut -d, -f"$fields"
}

for device in dummy tbr vulkan; do
    run "$device" "${good[$device]}" "$temporary/alone-$device" >"$temporary/out" 2>&1 ||
        fail "the good method alone on $device: $(cat "$temporary/out")"
done

# check ID DEVICE EXIT STATUS WORDS [ARGUMENT...]: status "skipped" is a run that stopped for it, and says so
check() {
    local id=$1 device=$2 expected=$3 status=$4 words=$5 directory=$temporary/$1-$2 code=0 began row
    shift 5
    began=$(date +%s)
    run "$device" "$id,${good[$device]}" "$directory" "$@" >"$temporary/out" 2>"$temporary/talk" || code=$?
    [ "$code" = "$expected" ] || fail "$id on $device: exit $code, not $expected: $(head -c 1000 "$temporary/talk")"
    [ $(($(date +%s) - began)) -le $((3 * timeout_s + 20)) ] || fail "$id on $device took too long"
    row=$(grep -E ",$id," "$directory/summary.csv" || true)
    grep -qE "^1,[0-9a-f]+,$status," <<<"$row" || fail "$id on $device: not $status: $row"
    if [ "$status" = skipped ]; then
        row=$(cat "$temporary/talk")
    fi
    grep -qE "$words" <<<"$row" || fail "$id on $device: not '$words': $row"
    [ "$(row_of_good "$directory" "$device")" = "$(row_of_good "$temporary/alone-$device" "$device")" ] ||
        fail "$id on $device: the good row is $(row_of_good "$directory" "$device")"
    [ ! -s "$temporary/out" ] || fail "$id on $device: something was printed"
    [ -z "$(find "$directory" -name '*.hook' -o -name '*.partial')" ] || fail "$id on $device: left files"
    expect_nothing_left "$id on $device"
    checked=$((checked + 1))
}

checked=0
in_after="in hook 'after' of ID\.so, pass 'ask'"
while IFS='|' read -r id device expected status words; do
    words=${words//IN_AFTER/$in_after}
    words=${words//CRASHED/$crashed}
    check "$id" "$device" "$expected" "$status" "${words//ID/$id}"
done <<'END'
nothing|dummy|0|ok|nothing
crashes|dummy|4|crash|CRASHEDIN_AFTER.*the first time
aborts|dummy|4|crash|CRASHEDIN_AFTER.*the first time
divides|dummy|4|crash|CRASHEDIN_AFTER.*the first time
exits|dummy|4|crash|exited with status 0 and left no result, IN_AFTER; and so the first time
spins|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER
sleeps|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER
stops|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER
prints-on|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER; its last words: "".*HOSTILE OUTPUT
raises-limits|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER
fills-disk|dummy|4|timeout|no answer within [0-9]+ s, IN_AFTER
kills-itself|dummy|5|skipped|kills-itself .*launch 0: killed by SIGKILL, IN_AFTER, twice
ends-itself|dummy|5|skipped|ends-itself .*launch 0: killed by SIGTERM, IN_AFTER, twice
kills-group|dummy|5|skipped|kills-group .*launch 0: killed by SIGKILL, IN_AFTER, twice
kills-parent|dummy|5|skipped|kills-parent .*launch 0: killed by SIGKILL, IN_AFTER, twice
prints|dummy|0|ok|prints
closes|dummy|0|ok|closes
forks|dummy|0|ok|forks
daemonises|dummy|0|ok|daemonises
answers-nonsense|dummy|4|plugin_error|ID: pass 'ask': after: answered 12345, no fm_next
repeats|dummy|4|plugin_error|ID: pass 'ask': after: answered FM_REPEAT \(1\), and no loop holds the pass
redoes|dummy|4|plugin_error|ID: asked for the frame again 8 times; after: answered FM_REDO \(2\)
wrong-image|vulkan|4|wrong_image|declared exact, but missing 0, extra 192,
endless-shader|vulkan|0|not_supported|loops of pass 'resolve' need more than|.*no answer within
crashes|vulkan|4|crash|CRASHEDIN_AFTER
predict-crashes|tbr|4|crash|CRASHEDin hook 'predict' of ID\.so
place-crashes|tbr|4|crash|CRASHEDin hook 'place' of ID\.so
sign-crashes|tbr|4|crash|CRASHEDin hook 'sign' of ID\.so
skip-crashes|tbr|4|crash|CRASHEDin hook .*'skip'.* of ID\.so
tile-end-crashes|tbr|4|crash|CRASHEDin hook .*'tile_end'.* of ID\.so
predict-spins|tbr|4|timeout|no answer within [0-9]+ s, in hook 'predict' of ID\.so
tile-end-spins|tbr|4|timeout|no answer within [0-9]+ s, in hook 'tile_end' of ID\.so
predict-nonsense|tbr|4|plugin_error|ID: frame 0: technique: predict: answered 12345
place-nonsense|tbr|4|plugin_error|ID: frame 0: technique: place: answered 12345
tile-end-nonsense|tbr|4|plugin_error|ID: frame 0: technique: tile_end: outcome: 12345
sign-nonsense|tbr|0|ok|sign-nonsense
END

# Files that it leaves open are told; where there can be no more, it is to blame, and not the run.
check leaks dummy 0 ok 'leaks left [0-9]+ files open'
rm -rf "$temporary/leaks-dummy"
(failed=0 && ulimit -n 64 && check leaks dummy 4 plugin_error 'Too many open files; leaks left [0-9]+ files open' && exit "$failed") ||
    fail "with few files"
if [ -d "$faulty/eats" ]; then
    check eats dummy 4 out_of_memory "killed by SIG[A-Z]*, ${in_after//ID/eats}" --memory-limit 512M --timeout 30
fi

# Slower by a factor, which gates are tried on: how often it stores the scene, whatever the machine does.
for row in 1,20 1.1,22 2.5,50; do
    factor=${row%,*} directory=$temporary/slower-$row
    FRAGMARK_TEST_SLOWER=$factor run vulkan slower "$directory" >"$temporary/out" 2>&1 ||
        fail "slower by $factor: $(cat "$temporary/out")"
    grep -qE "scene_passes,${row#*,}," "$directory/samples.csv" ||
        fail "slower by $factor: $(grep scene_passes "$directory/samples.csv")"
done

echo "$checked faulty plugins"
exit "$failed"
