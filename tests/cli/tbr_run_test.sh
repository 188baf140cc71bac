#!/usr/bin/env bash
# tbr_run_test.sh PROGRAM: techniques of the simulated GPU from the command line: cases, metrics, an axis
# of the models, and what is refused in which words.
set -euo pipefail
program=$1
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
"$program" run --device tbr --scene frames/adversarial --method all -a seed=1:4:+1 --no-report \
    -o "$work/adversarial" 2>"$work/log" || { cat "$work/log"; exit 1; }
[ "$(grep -c ',ok,' "$work/adversarial/summary.csv")" = 40 ] || fail "not 40 cases ok"
grep -q ',,,wrong_tiles,[1-9]' "$work/adversarial/samples.csv" || fail "EVR draws what was made to break it"

run --method tbr-base -a model=acumulate_cycles=2 -o "$work/typo" 2>"$work/log" && fail "a typo passed"
grep -q "nearest is 'accumulate_cycles'" "$work/log" || { cat "$work/log"; fail "no nearest name"; }
run --method kplus-array -o "$work/passes" 2>"$work/log" && fail "a method of passes ran"
grep -q "feed 'frames': the method takes" "$work/log" || { cat "$work/log"; fail "no reason"; }
