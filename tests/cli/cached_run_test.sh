#!/usr/bin/env bash
# cached_run_test.sh PROGRAM: a cache changes how long a run takes, and nothing that it says. Without one, with an
# empty one, with a full one and with a damaged one a run has the same rows, ids, codes, hashes of images,
# captured fragments and truths. Also: who says so (manifest.json, doctor), how it is turned off, and several
# runs at once.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
fail() {
    echo "$*"
    failed=1
}
export FRAGMARK_CACHE=$work/cache
"$program" list devices | grep -q '^vulkan' || exit 77

# measure NAME [ARGUMENT...]
measure() {
    local name=$1
    shift
    "$program" run -q --no-report --method kplus-heap,tile-k --scene layers,bunny --device vulkan -a k=4 \
        --feed raster,compute-pixel,triangles -a n=12 -a width_px=64 -a height_px=48 -a launches=1 -a frames=1 \
        -a warmup=0 --keep fragments,truth "$@" -o "$work/$name" 2>"$work/$name.talk" || fail "$name: $(cat "$work/$name.talk")"
}

# outcome NAME: all that hangs on no clock
outcome() {
    sed 's/"[^"]*"/text/g' "$work/$1/summary.csv" | awk -F, '
        NR == 1 {
            for (i = 1; i <= NF; i++)
                is_timed[i] = $i ~ /_(ms|ns|s|low|high)$/ || $i ~ /^(times_floor|noisy|message)$/
        }
        { for (i = 1; i <= NF; i++) printf "%s,", is_timed[i] ? "" : $i; print "" }'
    grep -o '"\(event\|case\|image_hashes\|shaders\|plugin\|driver\)": *\("[^"]*"\|\[[^]]*\]\)' "$work/$1/journal.jsonl"
    (cd "$work/$1" && sha256sum kept/* images/*)
}

# same NAME: as the run without a cache
same() {
    outcome "$1" >"$work/$1.outcome"
    diff "$work/none.outcome" "$work/$1.outcome" >"$work/difference" ||
        fail "$1: not as without a cache: $(head -c 600 "$work/difference")"
}

# says NAME true|false
says() {
    grep -q "\"cache\": $2" "$work/$1/manifest.json" ||
        fail "$1: the manifest does not say that a cache was used: $2"
}

count() {
    find "$FRAGMARK_CACHE/$1" -type f 2>/dev/null | wc -l
}

measure none --no-cache
outcome none >"$work/none.outcome"
[ "$(wc -l <"$work/none.outcome")" -gt 30 ] || fail "the outcome is short: $(cat "$work/none.outcome")"
says none false
[ "$(count spirv)$(count truth)" = 00 ] || fail "--no-cache left something"

measure cold
same cold
says cold true
spirv=$(count spirv) truths=$(count truth)
[ "$spirv" -gt 10 ] || fail "only $spirv compiled shaders were kept"
[ "$truths" = 8 ] || fail "$truths files of truths were kept, not 2 for each of 2 scenes and 2 rasterisers"

measure warm
same warm
[ "$(count spirv) $(count truth)" = "$spirv $truths" ] || fail "the second run kept other files"

FRAGMARK_CACHE=off measure off
same off
says off false

# Damage, one way after the other; what is damaged is replaced.
for how in cut flip empty foreign; do
    for file in "$FRAGMARK_CACHE"/*/*; do
        case $how in
        cut) truncate -s -1 "$file" ;;
        flip) printf '\xA5' | dd of="$file" bs=1 seek=$((RANDOM % $(stat -c %s "$file"))) conv=notrunc status=none ;;
        empty) : >"$file" ;;
        foreign) head -c 5000 /dev/urandom >"$file" ;;
        esac
    done
    measure "$how"
    same "$how"
    [ "$(count spirv) $(count truth)" = "$spirv $truths" ] || fail "$how: files are $(count spirv) $(count truth)"
done
measure mended
same mended

# Several at once, from nothing.
rm -r "$FRAGMARK_CACHE"
for i in 1 2 3; do
    measure "beside$i" &
done
wait
for i in 1 2 3; do
    same "beside$i"
done
[ "$(count spirv) $(count truth)" = "$spirv $truths" ] || fail "together: files are $(count spirv) $(count truth)"
[ -z "$(find "$FRAGMARK_CACHE" -name 'partial.*')" ] || fail "something was left half written"

# A folder that cannot be: slower, not wrong.
FRAGMARK_CACHE=/proc/nowhere measure nowhere
same nowhere

"$program" doctor >"$work/doctor" || true
grep -q "cache  *$FRAGMARK_CACHE" "$work/doctor" || fail "doctor does not name the cache: $(cat "$work/doctor")"
grep -q "spirv  *$spirv files" "$work/doctor" || fail "doctor does not count: $(grep -A5 cache "$work/doctor")"
FRAGMARK_CACHE=off "$program" doctor | grep -q 'cache  *none' || fail "doctor does not say that there is none"
exit "$failed"
