#!/usr/bin/env bash
# empty_test.sh PROGRAM: a picture in which nothing is drawn is ok, and the row, the terminal and the report's
# notes say that it is empty: on every device and feed, whatever the reason.
set -euo pipefail
program=$1
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
words='nothing was drawn: no fragment lies in the picture'
failed=0

sed -e "s|^mesh: |mesh: $root/scenes/|" -e 's/^target: .*/target: [0, 1, -0.2]/' -e 's/^fov_deg: .*/fov_deg: 20/' -e 's/^width_px: 1/width_px: 8/' \
    -e 's/^height_px: 1/height_px: 8/' "$root/scenes/kplus-example.yml" >"$work/away.yml"

# A triangle between the centres of four pixels.
printf 'v 0 0 -1\nv 1e-4 0 -1\nv 0 1e-4 -1\nf 1 2 3\n' >"$work/tiny.obj"
printf '%s\n' 'generator: mesh' 'mesh: tiny.obj' 'width_px: 8' 'height_px: 8' 'eye: [0, 0, 0]' \
    'target: [0, 0, -1]' 'fov_deg: 90' 'near_plane: 0.1' 'far_plane: 4' >"$work/tiny.yml"

# expect NAME ROWS ARGUMENT...: a run whose ROWS rows that are supported are all ok and empty
expect() {
    local name=$1 rows=$2
    shift 2
    "$program" run -q "$@" -a launches=1 -a frames=1 -a warmup=0 -o "$work/$name" 2>"$work/talk" || {
        echo "$name: exit code $?"
        cat "$work/talk"
        failed=1
    }
    local ok
    ok=$(grep -c ",ok,$words" "$work/$name/summary.csv" || true)
    if [ "$ok" -ne "$rows" ] || [ "$(grep -c -v ',not_supported,' "$work/$name/summary.csv")" -ne $((rows + 1)) ]; then
        echo "$name: $ok rows are ok and empty, not $rows:"
        cut -d, -f3-9 "$work/$name/summary.csv"
        failed=1
    fi
    grep -q "ok: $words" "$work/talk" || {
        echo "$name: the terminal does not say it:"
        cat "$work/talk"
        failed=1
    }
}

devices=vulkan
"$program" list devices | grep -q osmesa && devices=vulkan,osmesa
count=$(tr , '\n' <<<"$devices" | wc -l)
small=(--device "$devices" --no-report --scene layers -a width_px=16 -a height_px=16)
fragments=raster,compute-layer,compute-pixel,compute-adjacent
expect none $((8 * count)) "${small[@]}" --method exact,kplus-array --feed "$fragments" -a n=0
expect improbable $((2 * count)) "${small[@]}" --method kplus-heap --feed raster,compute-layer -a n=8 \
    -a fragment_probability=0
expect tiny $((2 * count)) --device "$devices" --no-report --scene "$work/tiny.yml" --method wboit,f2b-k
expect rasterised "$count" "${small[@]}" --method freepipe-compute --feed triangles -a n=0
expect away $((2 * count)) --device "$devices" --no-report --scene "$work/away.yml" --method exact,z-buffer
expect frames 2 --device tbr --no-report --scene frames/puzzle-static-1 --method tbr-base,tbr-evr -a width_px=64 \
    -a height_px=48 -a sequence_frames=2 -a backgrounds=0 -a sprites=0 -a triangles=0 -a hud=0

# Pictures with fragments say nothing.
"$program" run -q --no-report --scene layers --method exact -a n=1 -a width_px=16 -a height_px=16 -a launches=1 \
    -a frames=1 -a warmup=0 -o "$work/full" 2>"$work/talk"
"$program" run -q --no-report --device tbr --scene frames/gl-demo --method tbr-base -a sequence_frames=2 \
    -o "$work/one" 2>>"$work/talk"
if grep -q 'nothing was drawn' "$work/full/summary.csv" "$work/one/summary.csv" "$work/talk"; then
    echo "pictures with fragments are called empty"
    failed=1
fi
exit "$failed"
