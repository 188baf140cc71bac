#!/usr/bin/env bash
# linear_test.sh PROGRAM: whether tile-k's time is linear in triangles (10^4 to 10^7) and in fragments (10^6 to
# 3 10^8), all fragments wanted. Prints the fit t = a + b x by least squares of relative errors, and the residuals.
# Fails if between the two largest the time rises with a power above 1.25, which no linear cost does.
set -euo pipefail
program=$1
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT

# x and frame_ms of a scene
measure() { # X SCENE ARGUMENTS...
    local x=$1 scene=$2 out=$here/$RANDOM$RANDOM
    shift 2
    "$program" run --scene "$scene" --method tile-k --feed triangles "$@" -a launches=1 -a frames=20 \
        -a warmup=5 --no-report --no-images -o "$out" >"$here/log" 2>&1 || {
        cat "$here/log" >&2
        return 1
    }
    awk -F, -v x="$x" 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
        { gsub(/"[^"]*"/, "-"); row = x " " $column["frame_ms"]
          print row; print row > "/dev/stderr" }' "$out/summary.csv"
}

judge() { # NAME FILE of lines "x ms"
    awk -v name="$1" '
        { x[NR] = $1; y[NR] = $2; w = 1 / ($2 * $2)
          sw += w; sx += w * $1; sy += w * $2; sxx += w * $1 * $1; sxy += w * $1 * $2 }
        END {
            b = (sw * sxy - sx * sy) / (sw * sxx - sx * sx)
            a = (sy - b * sx) / sw
            printf "%s: %.4g ms + %.4g ns each\n", name, a, b * 1e6
            for (i = 1; i <= NR; i++)
                printf "  %10.0f: %.4g ms, residual %+.1f %%\n", x[i], y[i], 100 * (y[i] / (a + b * x[i]) - 1)
            power = log(y[NR] / y[NR - 1]) / log(x[NR] / x[NR - 1])
            printf "  power between the two largest: %.2f\n", power
            exit power > 1.25
        }' "$2"
}

# layers: 2 t^2 n triangles, 13.1 million fragments whatever t is
for t in 6 20 64; do
    measure $((2 * t * t * 128)) layers -a n=128 -a k=128 -a pixel_density=0.25 -a tessellation=$t
done >"$here/layers"
# bunnies of 69 652 triangles, ever more in the same space: triangles and fragments
for i in 1 12 48 144; do
    step=$(awk -v i=$i 'BEGIN { print (i > 1 ? 0.75 / (i - 1) : 0) }')
    measure $((69652 * i)) bunny -a k=4096 -a width_px=854 -a height_px=480 -a instances=$i \
        -a "instance_offset=$step 0 0"
done >"$here/bunnies"
# 370 000 triangles, 128 layers over all of ever larger images
for edge in 90 287 640 1531; do
    measure $((128 * edge * edge)) layers -a n=128 -a k=128 -a pixel_density=1 -a tessellation=38 \
        -a width_px=$edge -a height_px=$edge
done >"$here/fragments"

failed=0
judge "triangles of layers" "$here/layers" || failed=1
judge "triangles of bunnies" "$here/bunnies" || failed=1
judge fragments "$here/fragments" || failed=1
exit $failed
