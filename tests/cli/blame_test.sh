#!/usr/bin/env bash
# blame_test.sh PROGRAM: what the run cannot write or read, and what fragmark brings, is the run's fault.
# It stops with exit code 5, nobody gets a verdict, and the same command finishes once the fault is gone.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
arguments=(run -q --no-report --method exact --scene layers --device vulkan -a n=2 -a width_px=16
    -a height_px=16 -a launches=1 -a frames=1 -a warmup=0 -o "$work/out")
failed=0

# expect_incomplete WHAT: runs, and wants exit code 5, a message, and no row for the case
expect_incomplete() {
    local code=0
    "$program" "${arguments[@]}" 2>"$work/talk" || code=$?
    if [ "$code" -ne 5 ] || ! grep -q 'the same command continues' "$work/talk"; then
        echo "$1: exit code $code, not 5: $(cat "$work/talk")"
        failed=1
    fi
    if grep -q 'plugin_error\|not_supported\|crash' "$work/out/summary.csv"; then
        echo "$1: the method is blamed: $(tail -1 "$work/out/summary.csv")"
        failed=1
    fi
}

id=$("$program" plan "${arguments[@]:1}" --json | grep -o '"case_id": "[0-9a-f]*"' | grep -o '[0-9a-f]\{16\}')
mkdir -p "$work/out/images/$id.rgba32f"
expect_incomplete "a folder at the image's path"
truth=("$work"/out/truth/*.truth)
mv "${truth[0]}" "$work/kept"
mkdir "${truth[0]}"
expect_incomplete "a folder at the truth's path"

rmdir "${truth[0]}" "$work/out/images/$id.rgba32f"
head -c 100 "$work/kept" >"${truth[0]}"
expect_incomplete "a truth file that is cut off"
# a truth of one pixel without a fragment: kind, width and height, then as many zeros but one list
{ printf 'fmkept1\0\1\0\0\0\1\0\0\0\1\0\0\0'; head -c 12 /dev/zero
    printf '\1'; head -c 47 /dev/zero; } >"${truth[0]}"
expect_incomplete "the truth of another scene"

# finish WHAT: the same command, and the case is ok
finish() {
    "$program" "${arguments[@]}" 2>"$work/talk" || true
    if ! grep -q ",ok," "$work/out/summary.csv"; then
        echo "$1: the continued run is not ok: $(tail -1 "$work/out/summary.csv") $(cat "$work/talk")"
        failed=1
    fi
}
finish "after a truth that was made anew"

# Plugins of a broken installation: the runner's GLSL, and the floor.
methods=$(dirname "$program")/methods
cp -rL "$methods" "$work/methods"
export FRAGMARK_PLUGIN_PATH=$work/methods
for broken in common/emit.glsl null/store.glsl; do
    rm -rf "$work/out"
    mv "$work/methods/$broken" "$work/kept"
    [ "$broken" = common/emit.glsl ] || echo 'void store(' >"$work/methods/$broken"
    expect_incomplete "$broken is broken"
    mv "$work/kept" "$work/methods/$broken"
    finish "after $broken was mended"
done
exit "$failed"
