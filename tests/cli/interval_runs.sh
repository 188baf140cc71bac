#!/bin/bash
# Intervals on this machine. First a small run is repeated, and the intervals that hold the median of
# all runs' launches are counted; 34 of 40 is what chance allows. Then a method gets a second name, and
# the claims that tell the two apart are counted; 7 in 100 is what chance allows. No test, because it
# says as much of the machine as of fragmark. It takes minutes, a C compiler, and fragmark-report.
#   interval_runs.sh FRAGMARK [RUNS [LAUNCHES [PAIRS]]]      40, 3 and 40 unless told
program=$(readlink -f "${1:?the program fragmark}")
runs=${2:-40} launches=${3:-3} pairs=${4:-40}
source=$(dirname "$(readlink -f "$0")")/../..
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

cell() { # COLUMN DIR: its cell in the only row; quoted texts may hold commas
    sed 's/"[^"]*"/text/g' "$2/summary.csv" |
        awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i; next } { print $at }'
}

for run in $(seq "$runs"); do
    at=$work/run$run
    "$program" run --method kplus-array --scene layers -a k=8 -a n=32 -a width_px=107 -a height_px=60 \
        -a frames=1 -a warmup=1 -a launches="$launches" --no-report --no-images -q -o "$at" 2>/dev/null || exit 1
    grep ',frame_ms,' "$at/samples.csv" | cut -d, -f7 >>"$work/launches"
    echo "$(cell frame_ms_low "$at") $(cell frame_ms_high "$at") $(cell noisy "$at")" >>"$work/intervals"
done
sort -g "$work/launches" | awk '{ x[NR] = $1 }
    END { print NR % 2 ? x[(NR + 1) / 2] : (x[NR / 2] + x[NR / 2 + 1]) / 2, x[1], x[NR] }' >"$work/median"
awk 'NR == FNR { median = $1; range = $2 " to " $3; next }
    { held += $1 <= median && median <= $2; noisy += NF > 2 }
    END { print held " of " FNR " intervals hold " median " ms, the median of all launches (" range "); " noisy \
        " runs noisy" }' "$work/median" "$work/intervals"

# The twin differs in its id alone. One claim a pair and metric: the one name takes no longer than the other.
mkdir -p "$work/methods/twin" "$work/figures"
cp "$source/methods/kplus-array/"*.glsl "$work/methods/twin/"
sed 's/\.id = "kplus-array"/.id = "twin"/' "$source/methods/kplus-array/method.c" >"$work/methods/twin/method.c"
${CC:-cc} -shared -fPIC -I"$source/runner/include" -o "$work/methods/twin/twin.so" "$work/methods/twin/method.c" ||
    exit 1
for metric in frame_ms times_floor; do
    id=twins-${metric/_/-}
    {
        echo "{ id: $id, paper: twins, title: twins, run: { methods: [kplus-array, twin],"
        echo "scenes: [layers], feeds: [raster], k: 8, n: 32, width_px: 107, height_px: 60, frames: 1,"
        echo "warmup: 1, launches: $launches, seed: [$(seq -s, "$pairs")] },"
        echo "charts: [{ id: c, title: c, x: k, y: frame_ms }], claims: ["
        for pair in $(seq "$pairs"); do
            echo "{ id: T-$pair, text: t, at_most: 1, of: { method: twin, seed: $pair, metric: $metric },"
            echo "over: { method: kplus-array } },"
        done
        echo "] }"
    } >"$work/figures/$id.yml"
done
FRAGMARK_FIGURE_PATH=$work/figures "$program" reproduce twins --plugin-dir "$work/methods" --reference none \
    --no-images -q -o "$work/twins" >"$work/log" 2>&1 || { cat "$work/log" && exit 1; }
awk -F, 'NR > 1 { all[$3]++; decided[$3] += /,(holds|fails),/ }
    END { for (figure in all) print figure ": " decided[figure] " of " all[figure] " claims decided" }' \
    "$work/twins/claims.csv"
