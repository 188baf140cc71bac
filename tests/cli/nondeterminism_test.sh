#!/usr/bin/env bash
# nondeterminism_test.sh PROGRAM UNSTEADY_PLUGINS: what frames and launches that draw different
# pictures leave in tables, files and the report. The plugin's pictures are known: in a scene of one
# colour, of 16 columns, 1, 4 or 9 stay empty, so that errors are as 1 to 2 to 3.
set -euo pipefail
program=$1
export FRAGMARK_PLUGIN_PATH=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export FRAGMARK_TEST_LAUNCHES=$work/launches
failed=0

# measure DEVICE WRONG WARMUP ARGUMENT...: three launches of four frames
measure() {
    local device=$1 wrong=$2 warmup=$3
    shift 3
    rm -rf "$work/out" "$FRAGMARK_TEST_LAUNCHES"
    "$program" run -q --no-report --method unsteady --scene layers --device "$device" -a n=1 \
        -a "wrong=$wrong" -a width_px=16 -a height_px=12 -a pixel_density=1 -a launches=3 -a frames=4 \
        -a "warmup=$warmup" -o "$work/out" "$@" 2>"$work/talk" || { cat "$work/talk"; failed=1; }
}

# column NAME: the row's value. The device's name holds a comma, in quotes.
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i }
        NR == 2 { gsub(/"[^"]*"/, "quoted"); print $at }' "$work/out/summary.csv"
}

# expect NAME VALUE; times NAME FACTOR OF: within rounding of float pixels
expect() {
    [ "$(column "$1")" = "$2" ] && return
    echo "$what: $1 is '$(column "$1")', not '$2'"
    failed=1
}
times() {
    awk -v a="$(column "$1")" -v b="$(column "$3")" -v f="$2" \
        'BEGIN { exit !(b > 0.01 && (a / b / f - 1) ^ 2 < 1e-12) }' && return
    echo "$what: $1 is $(column "$1"), not $2 times $3, $(column "$3")"
    failed=1
}
launches() { # that have an error of their own: those that were the first to draw a picture
    awk -F, '$6 == "frames_rmse_max" { printf "%s", $4 }' "$work/out/samples.csv"
}

no_range_is_left() { # of a launch; a sanitizer may leave logs of a driver
    compgen -G "$work/out/work/*.rgba32f" >/dev/null || return 0
    echo "$what: a launch's range is left"
    failed=1
}

for device in vulkan osmesa; do
    for warmup in 0 4; do # with warm-up the last such frame's picture is the first timed one's
        what="$device, warm-up $warmup, steady"
        measure $device 0 $warmup
        expect distinct_images 1
        expect frames_drawn 12
        expect captured_frames 1
        expect distinct_fragments 1
        expect missing 12
        expect missing_max 12
        expect frames_rmse_max "$(column rmse)"
        expect frames_max_abs "$(column max_abs)"
        expect frames_total_rmse_max "$(column total_rmse)"
        [ "$(launches)" = 0 ] || { echo "$what: launches $(launches)"; failed=1; }
        compgen -G "$work/out/images/*.low.rgba32f" && { echo "$what: a range"; failed=1; }

        what="$device, warm-up $warmup, another picture in the second frame"
        measure $device 1 $warmup
        expect distinct_images 2
        expect captured_frames 4
        expect distinct_fragments 2
        expect missing 12
        expect missing_max 48
        times frames_rmse_max 2 rmse
        times frames_max_abs 1 max_abs
        times frames_total_rmse_max 2 total_rmse
        [ "$(launches)" = 0 ] || { echo "$what: launches $(launches)"; failed=1; }

        what="$device, warm-up $warmup, another picture in launch 1"
        measure $device 2 $warmup
        expect distinct_images 2
        expect captured_frames 1
        times frames_rmse_max 3 rmse
        [ "$(launches)" = 01 ] || { echo "$what: launches $(launches)"; failed=1; }

        what="$device, warm-up $warmup, both"
        measure $device 3 $warmup
        expect distinct_images 3
        expect distinct_fragments 2
        times frames_rmse_max 3 rmse
        [ "$(launches)" = 01 ] || { echo "$what: launches $(launches)"; failed=1; }
        no_range_is_left
    done
done

# Exposure scales errors and range alike.
what='one stop more'
measure vulkan 3 0 -a exposure=1
times frames_rmse_max 3 rmse
times frames_max_abs 1 max_abs

# Columns 1 to 8 of 16 were drawn in some frames and not in others: of both devices the same map.
for wrong in 2 3; do
    what="the report of wrong=$wrong"
    measure vulkan $wrong 0
    if command -v fragmark-report >/dev/null || [ -x "$(dirname "$program")/fragmark-report" ]; then
        "$program" report "$work/out" >/dev/null 2>"$work/talk" || { cat "$work/talk"; failed=1; }
        grep -q "range of $wrong pictures in 12 frames: at most [0-9.]*; 50 % of pixels" \
            "$work/out/report.html" || { echo "$what: no range"; failed=1; }
        grep -q "unsteady: $wrong pictures in 12 frames, rmse up to $(column frames_rmse_max | cut -c1-4)" \
            "$work/out/report.html" || { echo "$what: no note"; failed=1; }
        compgen -G "$work/out/images/*.range.png" >/dev/null || { echo "$what: no map"; failed=1; }
    fi
done

# Without pictures the numbers are the same, and nothing is left of ranges.
what='no images'
measure vulkan 3 0 --no-images
expect distinct_images 3
times frames_rmse_max 3 rmse
[ ! -e "$work/out/images" ] || { echo "$what: files"; failed=1; }
no_range_is_left
# A real race: whatever it does, its worst frame is no better than its last, and frames that differ
# leave a range.
FRAGMARK_PLUGIN_PATH=$(dirname "$program")/methods
what='kb, racing'
rm -rf "$work/out"
"$program" run -q --no-report --method kb --scene layers --device vulkan --feed compute-layer -a n=24 \
    -a k=8 -a width_px=200 -a height_px=150 -a launches=2 -a frames=4 -o "$work/out" 2>"$work/talk" ||
    { cat "$work/talk"; failed=1; }
expect captured_frames 4
expect frames_drawn 8
awk -v worst="$(column frames_rmse_max)" -v last="$(column rmse)" 'BEGIN { exit !(worst >= last) }' ||
    { echo "$what: the worst frame is better than the last"; failed=1; }
[ "$(column distinct_images)" = 1 ] || compgen -G "$work/out/images/*.low.rgba32f" >/dev/null ||
    { echo "$what: no range"; failed=1; }
exit "$failed"
