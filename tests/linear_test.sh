#!/usr/bin/env bash
# linear_test.sh PROGRAM: whether tile-k's time is linear in triangles (10^4 to 10^7, as many fragments) and
# in fragments (10^6 to 3 10^8, as many triangles), all fragments wanted. Prints the fit t = a + b x by least
# squares of relative errors, and the residuals. Fails if between the two largest the time rises with
# a power above 1.25, which no linear cost does.
set -euo pipefail
program=$1
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT

# x and frame_ms of a layers scene
measure() { # X ARGUMENTS...
    local x=$1 out=$here/$RANDOM$RANDOM
    shift
    "$program" run --scene layers --method tile-k --feed triangles "$@" -a launches=1 -a frames=3 \
        -a warmup=1 --no-report --no-images -o "$out" >"$here/log" 2>&1 || {
        cat "$here/log"
        return 1
    }
    awk -F, -v x="$x" 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i; next }
        { gsub(/"[^"]*"/, "-"); print x, $column["frame_ms"] }' "$out/summary.csv"
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

# 2 t^2 n triangles; n layers over 5 % of the viewport: 25 million fragments
for t in 2 6 20 64; do
    measure $((2 * t * t * 1221)) -a n=1221 -a k=1221 -a pixel_density=0.05 -a tessellation=$t
done >"$here/triangles"
# 370 000 triangles, or 375 000 where it takes more layers
{
    measure 1049000 -a n=128 -a k=128 -a tessellation=38 -a pixel_density=0.02
    measure 10494000 -a n=128 -a k=128 -a tessellation=38 -a pixel_density=0.2
    measure 52470000 -a n=128 -a k=128 -a tessellation=38 -a pixel_density=1
    measure 300069000 -a n=732 -a k=732 -a tessellation=16 -a pixel_density=1
} >"$here/fragments"

failed=0
judge triangles "$here/triangles" || failed=1
judge fragments "$here/fragments" || failed=1
exit $failed
