#!/usr/bin/env bash
# dump_test.sh PROGRAM: what `run --keep` keeps and `dump` shows. A racy method loses fragments; the states
# of all pixels add up to its row, and one pixel is shown with what it lacks. Ids and rows stay as they are
# without --keep; what cannot be kept stops the run; what cannot be read is refused.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
complain() {
    echo "$*"
    failed=1
}

arguments=(-q --no-report --no-images -a launches=1 -a frames=1 -a warmup=0)
small=(--feed compute-adjacent -a n=32 -a k=8 -a width_px=32 -a height_px=24)
racy=(--method kb,exact "${small[@]}")
run() { # FOLDER ARGUMENT...: the exit code is in $code, what it said in $work/talk
    local folder=$1
    shift
    code=0
    "$program" run "${arguments[@]}" "$@" -o "$folder" 2>"$work/talk" || code=$?
}
dump() { # ARGUMENT...: the exit code is in $code, its lines in $work/lines, what it said in $work/talk
    code=0
    "$program" dump "$@" >"$work/lines" 2>"$work/talk" || code=$?
}
column() { # FOLDER NAME METHOD: the cell of the method's row
    awk -F, -v name="$2" -v method="$3" '
        { gsub(/"[^"]*"/, "quoted") }
        NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
        $at["method"] == method { print $at[name] }' "$1/summary.csv"
}
expect() { # WHAT CODE [WORDS]: how the last one ended, and a part of what it said
    [ "$code" = "$2" ] || complain "$1: exit code $code, not $2: $(cat "$work/talk")"
    [ $# -lt 3 ] || grep -qF -- "$3" "$work/talk" || complain "$1: it does not say '$3': $(cat "$work/talk")"
}

run "$work/out" "${racy[@]}" --keep fragments,truth
expect "a run that keeps" 0
kb=$(column "$work/out" case_id kb)
exact=$(column "$work/out" case_id exact)
[ "$(column "$work/out" missing kb)" -gt 0 ] || complain "kb lost nothing: there is nothing to look at"

dump "$work/out"
expect "the list of cases" 0
grep -q "^$kb,ok,kb,vulkan,compute-adjacent,layers,32,8,.*,fragments+truth$" "$work/lines" ||
    complain "the list has not $kb: $(cat "$work/lines")"

# All pixels together are the row's counts; `exact` has each fragment of truth, in its order.
dump "$work/out" --method kb --rect 0,0,32,24
expect "all pixels" 0
counts=$(awk -F, '$10 ~ /missing/ { m++ } $10 ~ /extra/ { e++ } $10 ~ /misordered/ { o++ }
    END { printf "%d %d %d", m, e, o }' "$work/lines")
row="$(column "$work/out" missing kb) $(column "$work/out" extra kb) $(column "$work/out" misordered kb)"
[ "$counts" = "$row" ] || complain "the states add up to $counts, the row has $row"
dump "$work/out" --case "$exact" --rect 0,0,32,24
awk -F, 'NR > 1 && ($10 != "ok" || $3 != $11) { bad++ } END { exit bad > 0 || NR != 192 * 32 + 1 }' "$work/lines" ||
    complain "exact is not truth: $(head -3 "$work/lines")"
dump "$work/out" --method exact --wrong 3
expect "an exact method" 0 "0 pixels are wrong"
[ "$(wc -l <"$work/lines")" = 1 ] || complain "an exact method has wrong pixels"

# One wrong pixel: what is missing are the truths among the 8 nearest that were not handed over.
dump "$work/out" --method kb --wrong 2
IFS=, read -r x y _ _ handed missing _ < <(sed -n 2p "$work/lines")
dump "$work/out" --method kb --pixel "$x,$y"
expect "a wrong pixel" 0 "$handed handed over: $missing missing"
[ "$(grep -c ",missing,[0-7]$" "$work/lines")" = "$missing" ] || complain "pixel $x,$y: $(cat "$work/lines")"
[ "$(grep -c "^$x,$y,[0-9]" "$work/lines")" = "$handed" ] || complain "pixel $x,$y: $(cat "$work/lines")"
dump "$work/out/kept/$kb.fragments" --pixel "$x,$y"
expect "fragments alone" 0 "without truth nothing is compared"
[ "$(wc -l <"$work/lines")" = $((handed + 1)) ] || complain "fragments alone: $(cat "$work/lines")"

# What is wrong with the arguments.
dump "$work/out" --wrong 1
expect "two cases" 2 "--case $kb"
dump "$work/out" --case "${kb%?}x" --wrong 1
expect "a mistyped case" 2 "the nearest is '$kb'"
dump "$work/out" --case "$kb" --pixel 32,0
expect "a pixel outside" 2 "pixel 32,0 is outside: the picture of $kb has 32 x 24"
dump "$work/out" --case "$kb" --rect 4294967295,0,4294967295,1
expect "a huge rectangle" 2 "is outside"
dump "$work/out" --case "$kb" --frame 1
expect "no sequence" 2 "is no sequence"
dump "$work/out" --pixel 1
expect "half a pixel" 2 "--pixel 1: whole numbers"
run "$work/none" "${racy[@]}" --keep fragment
expect "an unknown word" 2 "the nearest is 'fragments'"
[ ! -e "$work/none" ] || complain "an unknown word: something was run"
mkfifo "$work/pipe"
dump "$work/pipe" --pixel 1,1
expect "a pipe" 2 "is a pipe"

# Damaged files.
cp "$work/out/kept/$kb.fragments" "$work/whole"
head -c 200 "$work/whole" >"$work/out/kept/$kb.fragments"
dump "$work/out" --case "$kb" --pixel 1,1
expect "a file that is cut off" 8 "$kb.fragments: damaged: its size is not what its header says"
cp "$work/out/kept/$kb.truth" "$work/out/kept/$kb.fragments.new"
mv "$work/out/kept/$kb.fragments.new" "$work/out/kept/$kb.fragments"
dump "$work/out" --case "$kb" --pixel 1,1
expect "truth under another name" 8 "damaged: it holds truth"

# Rows that an earlier run finished without: told, and measured no more. The rows are the same either way.
run "$work/before" "${racy[@]}"
for folder in before out; do
    for name in case_id status fragments_stored missing extra misordered rmse truncation_rmse; do
        echo "$name $(column "$work/$folder" $name exact)"
    done >"$work/$folder.rows"
    [ "$(column "$work/$folder" case_id kb)" = "$kb" ] || complain "$folder: another id"
done
cmp -s "$work/before.rows" "$work/out.rows" || complain "rows differ: $(diff "$work/before.rows" "$work/out.rows")"
dump "$work/before"
expect "nothing kept" 2 "nothing was kept"
cp "$work/before/summary.csv" "$work/rows"
run "$work/before" "${racy[@]}" --keep fragments,frames
expect "a run that goes on" 0 "2 rows were checked before and have no kept fragments"
grep -q "keep frames keeps nothing" "$work/talk" || complain "nobody is told that there are no frames"
cmp -s "$work/rows" "$work/before/summary.csv" || complain "rows of before were measured again"

# A disk that takes nothing: the run stops, nobody is blamed, and the same command goes on.
mkdir -p "$work/stopped/kept/$kb.fragments"
run "$work/stopped" --method kb "${small[@]}" --keep fragments,truth
expect "a folder in the place of a file" 5 "$kb.fragments: is a folder, not a file"
rmdir "$work/stopped/kept/$kb.fragments"
run "$work/stopped" --method kb "${small[@]}" --keep fragments,truth
expect "the same command" 0
[ "$(ls "$work/stopped/kept")" = "$(printf '%s\n' "$kb".{fragments,truth})" ] ||
    complain "what is kept: $(ls "$work/stopped/kept")"

# Sequences: published EVR is wrong in 5 tiles of frame 53.
run "$work/tbr" --device tbr --scene frames/adversarial --method tbr-evr -a seed=1 \
    --keep fragments,truth,frames
expect "a sequence" 0 "tiles"
dump "$work/tbr" --wrong 100
expect "wrong tiles" 0 "frames are wrong, in $(column "$work/tbr" wrong_tiles tbr-evr) tiles"
tiles=$(($(wc -l <"$work/lines") - 1))
[ "$tiles" = "$(column "$work/tbr" wrong_tiles tbr-evr)" ] || complain "$tiles wrong tiles are listed"
IFS=, read -r frame _ x y _ _ _ < <(sed -n 2p "$work/lines")
pixels=$(awk -F, -v frame="$frame" '$1 == frame { n += $7 } END { print n }' "$work/lines")
dump "$work/tbr" --frame "$frame"
expect "a wrong frame" 0 "$pixels wrong pixels"
[ "$(grep -c ",wrong$" "$work/lines")" = "$pixels" ] || complain "frame $frame has not $pixels wrong pixels"
dump "$work/tbr" --frame "$frame" --rect "$x,$y,2,2"
[ "$(wc -l <"$work/lines")" = 5 ] || complain "a rectangle of a frame: $(cat "$work/lines")"
dump "$work/tbr" --pixel 1,1
expect "a pixel of no frame" 2 "is a sequence"
exit "$failed"
