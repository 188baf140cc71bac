#!/usr/bin/env bash
# error_test.sh FRAGMARK: `fragmark error` of the pictures that a run kept says what the run measured;
# files of other kinds are read as they are meant, and refused with their reason.
set -euo pipefail
fragmark=${1:?usage: error_test.sh FRAGMARK}
out=$(mktemp -d)
trap 'rm -rf "$out"' EXIT
fail() { echo "error_test: $*" >&2; exit 1; }
# value COLUMN of the row in summary.csv; the message is quoted, and holds no comma here
summary() { awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) if ($i == name) at = i }
    NR == 2 { gsub(/"[^"]*"/, "x"); print $at }' "$out/run/summary.csv"; }
# value METRIC COLUMN of what error printed
printed() { awk -F, -v name="$1" -v column="$2" '$1 == name { print $column }' "$out/error.csv"; }
expect_near() { [ -n "$2" ] && [ -n "$3" ] || fail "$1 is missing"; awk -v a="$2" -v b="$3" 'BEGIN { d = a - b; exit !(d < 1e-6 && d > -1e-6) }' ||
    fail "$1: $2, not $3"; }

"$fragmark" run -q --method wboit -a n=8 -a width_px=40 -a height_px=30 -a launches=1 -a frames=1 -a warmup=0 \
    -o "$out/run" >/dev/null 2>&1 || fail "the run failed"
id=$(awk -F, 'NR == 2 { print $2 }' "$out/run/summary.csv")
image=$out/run/images/$id
[ -f "$image.exr" ] || fail "no $image.exr"
"$fragmark" error "$image.exr" "$image.truth.exr" --map "$out/map" >"$out/error.csv"
for metric in rmse psnr_db max_abs ssim flip flip_median flip_p95 flip_max; do
    expect_near "$metric" "$(printed $metric 2)" "$(summary $metric)"
    expect_near "covered_$metric" "$(printed $metric 3)" "$(summary covered_$metric)"
done
for map in absolute ssim flip; do
    [ -s "$out/map.$map.exr" ] && [ -s "$out/map.$map.png" ] || fail "no map $map"
done
"$fragmark" error "$image.exr" "$image.exr" --json >"$out/error.json"
grep -q '"psnr_db": "inf"' "$out/error.json" || fail "equal images: $(cat "$out/error.json")"

# One red pixel of alpha 128, unassociated: linear, it is (128/255, 0, 0, 128/255).
printf '\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\40\50\0\0\377\200' >"$out/red.tga"
printf 'PF\n1 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0' >"$out/black.pfm"
"$fragmark" error "$out/red.tga" "$out/black.pfm" >"$out/error.csv"
expect_near "red of half alpha" "$(printed rmse 2)" "$(awk 'BEGIN { a = 128 / 255; print sqrt((a * a + (1 - a) ^ 2) / 4) }')"
[ -z "$(printed ssim 2)" ] || fail "one pixel has an ssim"

# What is beyond [0,1] is told, unless --hdr measures it, and that an opaque reference is covered everywhere.
printf 'PF\n1 1\n-1.0\n\0\0\240\100\0\0\240\100\0\0\240\100' >"$out/five.pfm"
"$fragmark" error "$out/five.pfm" "$out/black.pfm" >/dev/null 2>"$out/said"
grep -q '1 pixels are beyond' "$out/said" && grep -q 'opaque everywhere' "$out/said" || fail "no note: $(cat "$out/said")"
"$fragmark" error --hdr "$out/five.pfm" "$out/black.pfm" >/dev/null 2>"$out/said"
! grep -q beyond "$out/said" || fail "a note with --hdr"
"$fragmark" error "$image.exr" "$image.exr" >/dev/null 2>"$out/said"
[ ! -s "$out/said" ] || fail "a note without need: $(cat "$out/said")"

# refused WORDS ARGUMENT...
refused() {
    local words=$1 code=0
    shift
    "$fragmark" error "$@" >"$out/said" 2>&1 || code=$?
    [ $code = 2 ] || fail "$*: exit code $code"
    grep -qF -- "$words" "$out/said" || fail "$*: '$words' is not in: $(cat "$out/said")"
}
printf 'PF\n2 1\n-1.0\n\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\0\300\177\0\0\0\0' >"$out/nan.pfm"
refused 'column 1, row 0: green is nan' "$out/nan.pfm" "$out/nan.pfm"
refused 'differ in size: 1 x 1 and 2 x 1' "$out/black.pfm" "$out/nan.pfm"
refused 'is a device' /dev/zero "$out/black.pfm"
refused 'is a folder' "$out" "$out/black.pfm"
refused 'No such file' "$out/none.png" "$out/black.pfm"
head -c 200 "$image.png" >"$out/cut.png"
refused 'cut.png' "$out/cut.png" "$image.png"
refused 'which images' "$image.png"
refused 'a number from 1' -p 0.2 "$image.png" "$image.png"
refused 'by-format, srgb or linear' -t sRGB "$image.png" "$image.png"
echo "error_test: passed"
