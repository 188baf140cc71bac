#!/usr/bin/env bash
# tbr_run_test.sh PROGRAM TEST_TECHNIQUES: techniques of the simulated GPU from the command line: cases, metrics, an axis
# of the models, and what is refused in which words.
set -euo pipefail
program=$1
plugins=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; exit 1; }

cat >"$work/small.yml" <<'END'
generator: frames
width_px: 100
height_px: 80
sequence_frames: 5
sprites: 12
object_px: 24
triangles: 60
hud: 0.3
hidden_churn: 0.5
END
run() { "$program" run --device tbr --scene "$work/small.yml" -a launches=1 --no-report "$@"; }

run --method all -a 'model=accumulate_cycles=2,accumulate_cycles=9' -o "$work/out" 2>"$work/log" ||
    { cat "$work/log"; exit 1; }
# Ten techniques, twice: all but tbr-evr are declared exact, so that a wrong tile would have failed.
[ "$(grep -c ',ok,' "$work/out/summary.csv")" = 20 ] || fail "not 20 cases ok"
grep -q 'model=accumulate_cycles=9' "$work/out/summary.csv" || fail "options do not tell the model"
grep -q '_ms,' "$work/out/samples.csv" && fail "simulated time stands in milliseconds"

# Of each case: tiles add up (7 x 5 in 4 frames), and parts of time and energy to their totals.
awk -F, '
    NR > 1 && $4 == "" { value[$3, $6] = $7; cases[$3] = 1
        if ($6 ~ /^energy\..*_nj$/) parts[$3] += $7 }
    END {
        for (c in cases) {
            n++
            if (value[c, "tiles_rendered"] + value[c, "tiles_skipped"] != 140) exit 1
            time = value[c, "cycles.geometry"] + value[c, "cycles.raster"]
            if (time <= 0 || (time / value[c, "cycles"] - 1) ^ 2 > 1e-12) exit 2
            both = time / (value[c, "cycles.geometry"] + value[c, "cycles.raster_b"])
            if (both > most) most = both
            if (n == 1 || both < least) least = both
            if ((parts[c] / value[c, "energy_nj"] - 1) ^ 2 > 1e-12) exit 3
        }
        if (most / least > 1.02) exit 5 # the two forms of the cycle model, as ratios of techniques
        exit n == 20 ? 0 : 4
    }' "$work/out/samples.csv" || fail "sums of samples.csv: $?"

# The same seed gives the same counts.
run --method tbr-evr-safe -o "$work/again" 2>/dev/null
counts() { grep ',,,' "$1/samples.csv" | grep -v per_core_s | cut -d, -f3,6-; }
run --method tbr-evr-safe -o "$work/third" 2>/dev/null
diff <(counts "$work/again") <(counts "$work/third") >/dev/null || fail "counts differ"

# Made to break techniques: published EVR draws some of it wrong; all others are declared exact.
"$program" run --device tbr --scene frames/adversarial --method all -a seed=1:4:+1 -a launches=1 --no-report \
    -o "$work/adversarial" 2>"$work/log" || { cat "$work/log"; exit 1; }
[ "$(grep -c ',ok,' "$work/adversarial/summary.csv")" = 40 ] || fail "not 40 cases ok"
# wrong_tiles sums the frames', and where there are any, the errors of all frames are there.
awk -F, '
    FNR == 1 { file++; for (i = 1; i <= NF; i++) at[file, $i] = i; next }
    file == 1 && $6 == "frame.wrong_tiles" { sum[$3] += $7; }
    file == 2 {
        tiles = $at[2, "wrong_tiles"]; id = $at[2, "case_id"]
        if (tiles == "" || tiles != sum[id]) exit 1
        if ((tiles > 0) != ($at[2, "rmse"] > 0) || (tiles > 0) != ($at[2, "max_abs"] > 0)) exit 2
        if ((tiles > 0) != ($at[2, "ssim"] < 1)) exit 3
        wrong += tiles > 0
    }
    END { print wrong + 0 }' "$work/adversarial/samples.csv" <(sed 's/"[^"]*"/quoted/g' "$work/adversarial/summary.csv") \
    >"$work/wrong" || fail "wrong tiles and image errors of a sequence: $?"
[ "$(cat "$work/wrong")" -gt 0 ] || fail "EVR draws what was made to break it"

# A technique that signs nothing, declared exact: the message says what is wrong and where it began.
"$program" run --device tbr --scene frames/adversarial --plugin-dir "$plugins" --method tbr-unsigned \
    -a launches=1 --no-report -q -o "$work/unsigned" 2>"$work/log" && fail "a wrong technique passed as exact"
grep -q 'wrong_image,"declared exact, but [0-9]* tiles in [0-9]* of [0-9]* frames are not the baseline.s, the first in frame [0-9]*"' \
    "$work/unsigned/summary.csv" || { cat "$work/unsigned/summary.csv"; fail "no wrong_image, or no frame"; }

run --method tbr-base -a model=acumulate_cycles=2 -o "$work/typo" 2>"$work/log" && fail "a typo passed"
grep -q "nearest is 'accumulate_cycles'" "$work/log" || { cat "$work/log"; fail "no nearest name"; }
run --method kplus-array -o "$work/passes" 2>"$work/log" && fail "a method of passes ran"
grep -q "feed 'frames': the method takes" "$work/log" || { cat "$work/log"; fail "no reason"; }
