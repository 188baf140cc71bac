#!/usr/bin/env bash
# merge_test.sh PROGRAM: shards that are merged are the unsharded run: 16 on device dummy, 3 on vulkan, and
# a figure with its tables in 2. What does not fit together is refused with its own exit code, and what
# lacks is named.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

complain() {
    echo "$*"
    failed=1
}

# The columns of a summary that the same code gives alike, whatever the machine was doing.
"$program" list metrics --json |
    awk -F'"' '$2 == "name" { name = $4 } /"is_measured": true/ { print name }' >"$work/measured"
[ -s "$work/measured" ] || complain "no metric is measured?"
repeating() { # FILE
    awk -F, 'NR == FNR { skip[$1] = skip[$1 "_low"] = skip[$1 "_high"] = 1; next }
        FNR == 1 { skip["message"] = skip["noisy"] = skip["samples"] = 1 }
        FNR == 1 { for (i = 1; i <= NF; i++) if (!($i in skip)) take[++count] = i }
        { for (i = 1; i <= count; i++) printf "%s,", $take[i]; print "" }' "$work/measured" <(sed 's/"[^"]*"/quoted/g' "$1")
}

# same WHOLE MERGED: ids, repeating columns, images, and as many samples of each case and metric
same() {
    [ "$(cut -d, -f2 "$1/summary.csv")" = "$(cut -d, -f2 "$2/summary.csv")" ] || complain "$2: other ids"
    [ "$(repeating "$1/summary.csv" | head -1 | tr -cd , | wc -c)" -gt 40 ] || complain "too few columns are held"
    diff <(repeating "$1/summary.csv") <(repeating "$2/summary.csv") >"$work/diff" ||
        complain "$2: other rows: $(head -4 "$work/diff")"
    diff -r "$1/images" "$2/images" || complain "$2: other images"
    diff <(cut -d, -f3,4,6 "$1/samples.csv" | sort | uniq -c) \
        <(cut -d, -f3,4,6 "$2/samples.csv" | sort | uniq -c) >/dev/null || complain "$2: other samples"
}

# expect CODE TEXT ARGUMENT...: exit code and what is told
expect() {
    local wanted=$1 text=$2 code=0
    shift 2
    "$program" "$@" >"$work/talk" 2>&1 || code=$?
    [ "$code" = "$wanted" ] || complain "fragmark $*: exit code $code, not $wanted: $(tail -3 "$work/talk")"
    grep -q -- "$text" "$work/talk" || complain "fragmark $*: does not say '$text': $(tail -3 "$work/talk")"
}

# Device dummy: 16 shards, of which some have the references alone
arguments=(-q --method exact,kb,ab-array --device dummy -a k=4,8 -a n=2,4,6,8,10,12 -a width_px=16,32
    -a height_px=12 -a launches=2 -a frames=2)
"$program" run "${arguments[@]}" --no-report -o "$work/whole" >/dev/null 2>&1
for i in $(seq 16); do
    "$program" run "${arguments[@]}" --shard "$i/16" -o "$work/shards/$i" >/dev/null 2>&1 ||
        complain "shard $i: exit code $?"
done
expect 0 '16 of 16 shards, 48 of 48 cases' merge "$work"/shards/* -o "$work/merged" --no-report
same "$work/whole" "$work/merged"
[ "$(grep -c ',1,ok,' "$work/merged/shards.csv")" = 48 ] || complain "shards.csv does not say whose the rows are"
[ "$(grep -c ',0,ok,' "$work/merged/shards.csv")" = 15 ] || complain "shards.csv lacks the references"
# All cases of a workload have one shard, so that their ratios are of one machine.
awk -F, 'NR == FNR { if ($4 == 1) shard[$1] = $2; next }
    FNR > 1 { place = $11 "," $13; if (place in of && of[place] != shard[$2]) bad = 1; of[place] = shard[$2] }
    END { exit bad }' "$work/merged/shards.csv" "$work/merged/summary.csv" || complain "a workload was parted"

# Again into the same folder; into others'
expect 0 '48 of 48' merge "$work"/shards/* -o "$work/merged" --no-report
same "$work/whole" "$work/merged"
expect 2 'holds something else' merge "$work"/shards/* -o "$work/whole"
expect 2 'holds something else' merge "$work"/shards/* -o "$work/shards/1"
expect 2 'Not a directory\|is not a folder' merge "$work"/shards/* -o "$work/talk"
expect 2 'where to' merge "$work"/shards/*
expect 2 'which folders' merge -o "$work/x"

# What lacks is named, and what is there is merged
expect 5 'shard 2/16 is missing' merge "$work/shards/1" "$work/shards/3" -o "$work/part" --no-report
[ -s "$work/part/summary.csv" ] || complain "what was there was not merged"
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    expect 5 'shard 2/16 is missing' report "$work/part"
    grep -q 'shard 2/16 is missing' "$work/part/report.html" || complain "the report does not say what lacks"
fi
expect 0 '48 of 48' merge "$work"/shards/* -o "$work/part" --no-report
[ ! -e "$work/part/report.html" ] || "$program" report "$work/part" >/dev/null 2>&1 || complain "no report of the whole"
grep -qs 'is missing' "$work/part/report.html" && complain "the report of the whole says that shards are missing"
find "$work/part/images" -not -name '*.rgba32f' -type f -delete # the report's
same "$work/whole" "$work/part"

# A shard that somebody ended; its command continues it
# It may end before the signal comes; then it is tried again.
stopped=
for _ in $(seq 30); do
    rm -rf "$work/slow/1"
    "$program" run "${arguments[@]}" --shard 1/16 -o "$work/slow/1" >/dev/null 2>&1 &
    child=$!
    while kill -0 "$child" 2>/dev/null &&
        [ "$(cat "$work/slow/1/journal.jsonl" 2>/dev/null | grep -c '"event":"end"')" -lt 3 ]; do
        sleep 0.01
    done
    kill -TERM "$child" 2>/dev/null || true
    wait "$child" || { stopped=yes; break; }
done
[ -n "$stopped" ] || complain "the shard always ended before it was killed"
expect 5 'shard 1/16 in .* is not finished' merge "$work/slow/1" "$work"/shards/{2..16} -o "$work/y" --no-report
expect 2 'it is shard 1/16' run "${arguments[@]}" --shard 2/16 -o "$work/slow/1"
expect 0 '' run "${arguments[@]}" --shard 1/16 -o "$work/slow/1"
expect 0 '48 of 48' merge "$work/slow/1" "$work"/shards/{2..16} -o "$work/y" --no-report
same "$work/whole" "$work/y"

# What is no shard, or none of these
expect 2 'No such file' merge "$work/shards/1" "$work/nowhere" -o "$work/z"
expect 2 'is a whole run' merge "$work/shards/1" "$work/whole" -o "$work/z"
expect 2 'is merged already' merge "$work/shards/1" "$work/merged" -o "$work/z"
expect 8 'no folder of a shard' merge "$work/shards/1" "$work" -o "$work/z"
cp -r "$work/shards/1" "$work/twin"
expect 2 'are both shard 1/16' merge "$work"/shards/* "$work/twin" -o "$work/z"
"$program" run "${arguments[@]}" -a launches=1 --shard 1/16 -o "$work/other" >/dev/null 2>&1 || true
"$program" run "${arguments[@]}" --seed 9 --shard 2/16 -o "$work/other" >/dev/null 2>&1 || true
expect 2 'no shards of one plan' merge "$work/other" "$work/shards/1" -o "$work/z"

# Damage: a case of another shard, a shard that cannot be, JSON that is none, a table that lacks
damage() { # CODE TEXT SED FILE
    rm -rf "$work/twin"
    cp -r "$work/shards/1" "$work/twin"
    sed -i "$3" "$work/twin/$4"
    expect "$1" "$2" merge "$work/twin" "$work"/shards/{2..16} -o "$work/z"
    [ ! -e "$work/z" ] || complain "$4: something was written"
}
damage 8 'index, count and plan' 's/"index": 1,/"index": 17,/' manifest.json
damage 8 'manifest.json:[0-9]' '1s/{/[{/' manifest.json
damage 8 'a case.s id' '2s/,[0-9]*,/,17,/' shard.csv
damage 8 'is none of shard' '2s/,[0-9a-f]\{16\},/,0123456789abcdef,/' summary.csv
damage 8 'cells where' '3s/,/,,/' summary.csv
damage 8 'has two rows' '2{h;G}' summary.csv

rm -rf "$work/twin"
cp -r "$work/shards/1" "$work/twin"
rm "$work/twin/samples.csv"
expect 8 'samples.csv: No such file' merge "$work/twin" "$work"/shards/{2..16} -o "$work/torn" --no-report
expect 0 '48 of 48' merge "$work"/shards/* -o "$work/torn" --no-report
same "$work/whole" "$work/torn"
expect 2 '/proc/nowhere' merge "$work"/shards/* -o /proc/nowhere/x

# A reference that differs where it must not; one whose time differs
id=$(awk -F, '$3 == 1 { print $1 }' "$work/shards/2/shard.csv")
column() { # NAME: its number
    head -1 "$work/whole/summary.csv" | tr , '\n' | grep -nx "$1" | cut -d: -f1
}
change() { # COLUMN VALUE: of the reference in shard 2
    rm -rf "$work/twin"
    cp -r "$work/shards/2" "$work/twin"
    awk -F, -v OFS=, -v id="$id" -v column="$(column "$1")" -v value="$2" \
        '$2 == id { $column = value } { print }' "$work/shards/2/summary.csv" >"$work/twin/summary.csv"
}
change bytes_allocated 7
expect 7 "case $id: bytes_allocated is" merge "$work/shards/1" "$work/twin" "$work"/shards/{3..16} -o "$work/z"
change status crash
expect 7 "case $id: status is" merge "$work/shards/1" "$work/twin" "$work"/shards/{3..16} -o "$work/z"
change frame_ms 7
expect 0 '48 of 48' merge "$work/shards/1" "$work/twin" "$work"/shards/{3..16} -o "$work/times" --no-report
same "$work/whole" "$work/times"

# Other GLSL in one shard
mkdir -p "$work/methods"
for method in exact kb ab-array null common; do
    cp -rL "$(dirname "$program")/methods/$method" "$work/methods/"
done
echo '// mine' >>"$work/methods/kb/store.glsl"
FRAGMARK_PLUGIN_PATH="$work/methods" "$program" run "${arguments[@]}" --shard 2/16 -o "$work/edited" >/dev/null 2>&1
expect 7 'store.glsl of kb differs' merge "$work/shards/1" "$work/edited" "$work"/shards/{3..16} -o "$work/z"

# A figure with its tables: the shards know what its cases are for
figure=(reproduce kplus-05 sbuffer-memory --smoke -q --device dummy --no-report -a launches=1)
"$program" "${figure[@]}" -o "$work/figure" >/dev/null 2>&1 || true
for i in 1 2; do
    "$program" "${figure[@]}" --shard "$i/2" -o "$work/half/$i" >/dev/null 2>&1 || true
done
"$program" merge "$work/half/1" "$work/half/2" -o "$work/both" --no-report >/dev/null 2>&1 || true
diff <(sort "$work/figure/figures.csv") <(sort "$work/both/figures.csv") || complain "other figures.csv"
cmp "$work/figure/memory.csv" "$work/both/memory.csv" || complain "other memory.csv"
[ -e "$work/both/specs/kplus-05-run1.yml" ] || complain "specs were left behind"

# A real device: the pictures are the same
arguments=(-q --method exact,kplus-array --device vulkan --feed compute-layer -a k=4 -a n=3,6,9 -a width_px=24
    -a height_px=16 -a launches=1 -a frames=1 -a warmup=0)
if "$program" run "${arguments[@]}" --no-report -o "$work/v/whole" >/dev/null 2>&1; then
    for i in 1 2 3; do
        "$program" run "${arguments[@]}" --shard "$i/3" -o "$work/v/$i" >/dev/null 2>&1 || complain "vulkan: shard $i"
    done
    expect 0 '6 of 6 cases' merge "$work"/v/{1,2,3} -o "$work/v/all" --no-report
    same "$work/v/whole" "$work/v/all"
    [ "$(find "$work/v/all/images" -size +100c | wc -l)" -ge 6 ] || complain "vulkan: no pictures"
else
    echo "no device vulkan: left out"
fi

# Bad arguments
expect 2 'the shards are 1/4 to 4/4' run --shard 5/4
expect 2 'I/N' run --shard 4
expect 2 'of which --shard' run --shard-reference kb
expect 2 "the nearest is 'kb'" run --method kb --device dummy --shard 1/2 --shard-reference kbb
exit "$failed"
