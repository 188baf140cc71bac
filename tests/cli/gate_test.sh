#!/usr/bin/env bash
# gate_test.sh PROGRAM: `gate` on a software rasteriser. A copy of kplus-heap outside of the tree whose shader was made
# slower is found, confirmed and named, with exit code 1, and so is a copied build whose common GLSL is slower; copies that
# are equal end with 0. Processor time decides, since other programs hardly change it. GATES=N runs N gates of equal copies (1), and tells what they said.
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/slower_copy.sh"
program=$1
gates=${GATES:-1}
methods=$(dirname "$program")/methods
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "gate_test: $*" >&2; exit 1; }
"$program" doctor 2>&1 | grep -qi 'llvmpipe' || { echo "gate_test: no lavapipe here"; exit 77; }
small=(-q --no-images --calibration none -a n=16 -a k=4 -a width_px=214 -a height_px=120)

mkdir -p "$work/base" "$work/equal"
for folder in base equal; do cp -rL "$methods/kplus-heap" "$work/$folder/"; done
slower_copy "$methods" "$work/slow" 2000

code=0
"$program" gate "$work/base" "$work/slow" "${small[@]}" --pairs 10,20 -o "$work/slower" >"$work/said" 2>&1 || code=$?
[ $code = 1 ] || fail "slower: exit code $code: $(cat "$work/said")"
grep '^worse .*kplus-heap .*confirmed on 10 fresh pairs' "$work/said" >/dev/null || fail "the case is not named: $(cat "$work/said")"
grep -q ',confirmation,' "$work/slower/pairs.csv" || fail "nothing was measured to confirm it"

# A copied build whose common GLSL is slower, by its own program.
mkdir "$work/build"
cp "$program" "$work/build/"
cp -rL "$methods" "$work/build/methods"
sed -i '/^uint array_slot/,/^{/ s/^{/{\n    uint x = i;\n    FM_LOOP for (uint j = 0u; j < 60u; j++)\n        x = x * 1664525u + 1013904223u;\n    if (x == 0xFFFFFFFFu \&\& pixel.y == 0x7FFFFFFFu)\n        return 0u;/' \
    "$work/build/methods/common/array.glsl"
! cmp -s "$work/build/methods/common/array.glsl" "$methods/common/array.glsl" || fail "array.glsl is not as it was: the copy is no slower"
code=0
"$program" ab kplus-heap@"$(dirname "$program")" kplus-heap@"$work/build" "${small[@]}" --pairs 10,20 -o "$work/builds" >"$work/said" 2>&1 || code=$?
[ $code = 1 ] || fail "a slower build: exit code $code: $(cat "$work/said")"
grep '^worse .*kplus-heap .*confirmed on 10 fresh pairs' "$work/said" >/dev/null || fail "a slower build: $(cat "$work/said")"
grep -qF "\"program\": \"$work/build/fragmark\"" "$work/builds/new/manifest.json" || fail "the copy's program did not measure it"

wrong=0
for i in $(seq "$gates"); do
    code=0
    "$program" gate "$work/base" "$work/equal" "${small[@]}" --seed "$i" --pairs 10,20 -o "$work/equal-$i" >"$work/said" 2>&1 || code=$?
    grep '^\(worse\|unclear\|same\|better\)' "$work/said"
    [ $code = 0 ] || [ $code = 1 ] || fail "equal: exit code $code: $(cat "$work/said")"
    wrong=$((wrong + code))
done
[ $wrong = 0 ] || fail "$wrong of $gates gates of equal copies ended with 1"
echo "gate_test: passed"
