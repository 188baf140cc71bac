#!/bin/bash
# `fragmark calibrate device`, and what runs and reports make of it. Arguments: the program fragmark.
program=$1
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export XDG_STATE_HOME=$work/state
failed=0
complain() {
    echo "$1"
    failed=1
}
# The cell of a column in the row of a method; quoted texts may hold commas.
cell() { # FILE METHOD COLUMN
    sed 's/"[^"]*"//g' "$1" | awk -v method="$2" -v column="$3" -F, '
        NR == 1 { for (i = 1; i <= NF; i++) { if ($i == column) at = i; if ($i == "method") of = i } }
        NR > 1 && $of == method { print $at }'
}
run() { # DIR [ARGUMENT...]
    local to=$1
    shift
    "$program" run --scene layers -a n=4 -a k=4 -a width_px=64 -a height_px=48 -a launches=3 -a frames=2 -a warmup=1 \
        --no-images -o "$to" "$@" >"$work/out.txt" 2>"$work/talk" || complain "the run in $to failed: $(cat "$work/talk")"
}

# Without a calibration: counts, and no bound.
run "$work/before" --device vulkan --method kplus-array,null
grep -q 'not calibrated here.*fragmark calibrate device --device vulkan' "$work/talk" ||
    complain "the end of a run does not say what is missing"
for column in bound_ms times_bound limited_by device_bytes_per_s; do
    [ -z "$(cell "$work/before/summary.csv" kplus-array $column)" ] || complain "$column is not empty uncalibrated"
done
[ "$(cell "$work/before/summary.csv" kplus-array bytes_moved)" -gt 0 ] || complain "bytes are not counted"
[ "$(cell "$work/before/summary.csv" null bytes_moved)" = 0 ] || complain "null moves bytes"
[ "$(cell "$work/before/summary.csv" null atomics)" = 0 ] || complain "null has atomics"
grep -q 'moved.fragments_b,[0-9]*,B' "$work/before/samples.csv" || complain "no bytes of one resource"
grep -q ',accesses_outside,0,' "$work/before/samples.csv" || complain "accesses out of range are not told"

# Usage.
"$program" calibrate device --help >"$work/help" || complain "no help"
grep -q 'times_bound' "$work/help" || complain "the help does not say what it is for"
"$program" calibrate device --device nothing 2>"$work/talk" && complain "a device that is not there is calibrated"
grep -q 'no such device' "$work/talk" || complain "nothing is said of a device that is not there"
"$program" calibrate device nonsense 2>/dev/null && complain "a word too many is taken"

# Calibrating.
began=$SECONDS
"$program" calibrate device --device vulkan >"$work/table" 2>"$work/talk" || complain "calibrating failed: $(cat "$work/talk")"
[ $((SECONDS - began)) -lt 120 ] || complain "it took $((SECONDS - began)) s"
for line in 'copying.*GB/s' 'atomics, a word each.*10^9/s' 'atomics, one word.*10^9/s' 'a compute pass of nothing.*ns' \
    'fragments rasterised, none kept.*10^9/s'; do
    grep -q "$line" "$work/table" || complain "the table has no line '$line'"
done
grep -q "kept in $work/state/fragmark/devices.json" "$work/talk" || complain "it does not say where it is kept"
"$program" calibrate device --device vulkan --json -o "$work/other.json" 2>/dev/null | grep -q '"atomics_own"' ||
    complain "no JSON"
grep -q '"schema": 1' "$work/other.json" || complain "-o is not written"

# With it.
run "$work/after" --device vulkan --method kplus-array,ab-ll,null
grep -q 'not calibrated' "$work/talk" && complain "a calibrated device is missed"
for method in kplus-array ab-ll; do
    bound=$(cell "$work/after/summary.csv" $method times_bound)
    awk "BEGIN { exit !($bound > 0.2) }" || complain "$method: times_bound is $bound"
    for column in bound_ms times_bound_low times_bound_high device_bytes_per_s device_atomics_per_s device_fragments_per_s; do
        [ -n "$(cell "$work/after/summary.csv" $method $column)" ] || complain "$method: $column is empty"
    done
    case $(cell "$work/after/summary.csv" $method limited_by) in
    feed | bytes | atomics) ;;
    *) complain "$method: limited_by says '$(cell "$work/after/summary.csv" $method limited_by)'" ;;
    esac
done
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    grep -q 'What the device allows' "$work/after/report.html" || complain "the report has no section"
    [ -s "$work/after/charts/roofline-1.svg" ] || complain "the report has no chart"
    grep -q 'No device of this run was calibrated' "$work/before/report.html" || complain "nothing is said uncalibrated"
fi

# A damaged file costs columns, and no run.
echo '{"schema": 1, "devices": [7]}' >"$work/state/fragmark/devices.json"
run "$work/damaged" --device vulkan --method kplus-array
grep -q 'devices.json: device 1 has no limits' "$work/talk" || complain "a damaged file is not told"
[ -z "$(cell "$work/damaged/summary.csv" kplus-array bound_ms)" ] || complain "a damaged file has limits"
"$program" calibrate device --device vulkan 2>"$work/talk" >/dev/null && complain "a damaged file is written over"
grep -q 'remove the file' "$work/talk" || complain "it is not said what to do with a damaged file"
exit "$failed"
