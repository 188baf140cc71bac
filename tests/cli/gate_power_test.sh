#!/usr/bin/env bash
# gate_power_test.sh PROGRAM: how often `gate` is right on this machine, on a software rasteriser. Calibrates, makes
# copies of kplus-heap that need 5 %, 10 % and the detectable share more processor time, and gates each of them many
# times against an equal copy: EQUAL=N gates of equal copies (30), SLOWER=N of each slower one (10), with the intervals
# of their counts. An equal copy must never be worse; of the slower ones 9 in 10 must be found. About 25 minutes.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/slower_copy.sh"
program=$1
equal=${EQUAL:-30}
slower=${SLOWER:-10}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "gate_power_test: $*" >&2; exit 1; }
"$program" doctor 2>&1 | grep -qi 'llvmpipe' || { echo "gate_power_test: no lavapipe here"; exit 77; }
case=(-a n=16 -a k=4 -a width_px=214 -a height_px=120)

copy() { slower_copy "$(dirname "$program")/methods" "$work/$1" "$2"; }

# effect NEW: by what NEW's processor time is more than base's, of 60 pairs; a logarithm.
effect() {
    "$program" ab "kplus-heap@$work/base" "kplus-heap@$work/$1" -q --no-images --calibration none "${case[@]}" \
        --pairs 60 -o "$work/tune-$1" >"$work/said" 2>&1 || true
    # A device's name holds a comma: columns are counted from the end.
    awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == "cpu_shift") from_end = NF - i }
        NR == 2 { print log($(NF - from_end)) }' "$work/tune-$1/ab.csv"
}

# interval FOUND COUNT: "9 of 10 (55 to 100 %)", Clopper and Pearson's at 95 %.
interval() {
    awk -v x="$1" -v n="$2" 'function tail(p, from, to,   i, j, term, sum) {
            for (i = from; i <= to; i++) {
                term = 1
                for (j = 1; j <= i; j++) term *= (n - i + j) / j
                sum += term * p ^ i * (1 - p) ^ (n - i)
            }
            return sum
        }
        BEGIN {
            low = 0
            high = 1
            for (step = 0.5; step > 1e-7 && x > 0; step /= 2)
                if (tail(low + step, x, n) < 0.025) low += step
            for (step = 0.5; step > 1e-7 && x < n; step /= 2)
                if (tail(high - step, 0, x) < 0.025) high -= step
            printf "%d of %d (%.0f to %.0f %%)\n", x, n, 100 * low, 100 * high
        }'
}

# gates NAME COUNT OPTION...: prints how many ended with 1 and named the case.
gates() {
    local name=$1 count=$2 found=0 code i
    shift 2
    for i in $(seq "$count"); do
        code=0
        "$program" gate "$work/base" "$work/$name" -q --no-images --calibration "$work/calibration.json" "${case[@]}" \
            --seed "$i" "$@" -o "$work/$name-$i" >"$work/said" 2>&1 || code=$?
        [ $code = 0 ] || [ $code = 1 ] || fail "$name: exit code $code: $(cat "$work/said")"
        [ $code = 0 ] || grep '^worse .*kplus-heap .*confirmed' "$work/said" >/dev/null || fail "no case is named: $(cat "$work/said")"
        found=$((found + code))
        { echo "$name $i: exit code $code"; grep -E '^(worse|unclear|same|better|time|cpu)|^ +(time|cpu)' "$work/said" || true; } >&2
        rm -rf "$work/$name-$i"
    done
    echo "$found"
}

copy base 0
"$program" calibrate --method kplus-heap --plugin-dir "$work/base" "${case[@]}" -q --pairs 60 -o "$work/calibration.json"
detectable=$(awk -F: '/"cpu": \{/ { inside = 1 } inside && /"detectable":/ { print $2 + 0; exit }' "$work/calibration.json")
copy tuning 400
per_loop=$(effect tuning)
echo "400 loops: $per_loop as a logarithm; detectable: $detectable"
loops() { awk -v wanted="$1" -v of="$per_loop" 'BEGIN { printf "%d\n", 400 * (exp(wanted) - 1) / (exp(of) - 1) + 0.5 }'; }
copy equal 0
copy detectable "$(loops "$detectable")"
copy five "$(loops 0.0488)"
copy ten "$(loops 0.0953)"

wrong=$(gates equal "$equal")
detected=$(gates detectable "$slower")
tens=$(gates ten "$slower")
fives=$(gates five "$slower" --pairs 20)
echo "equal copies called worse:                 $(interval "$wrong" "$equal")"
echo "detectable, $detectable as a logarithm:    $(interval "$detected" "$slower")"
echo "10 % more processor time:                  $(interval "$tens" "$slower")"
echo "5 % more, 20 pairs:                        $(interval "$fives" "$slower")"
[ "$wrong" = 0 ] || fail "$wrong of $equal gates of equal copies said worse"
for found in "$detected" "$tens" "$fives"; do
    [ $((10 * found)) -ge $((9 * slower)) ] || fail "found in $found of $slower gates"
done
echo "gate_power_test: passed"
