#!/usr/bin/env bash
# pack_test.sh PROGRAM: a pack is what was packed, to the byte; what is damaged, lacks or was added is
# named; so is what is another here. What is no pack is refused.
set -euo pipefail
program=$1
command -v tar >/dev/null || { echo "no tar here"; exit 77; }
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
export TMPDIR="$work/tmp"
mkdir "$TMPDIR"
failed=0

complain() {
    echo "$*"
    failed=1
}

# expect CODE TEXT ARGUMENT...
expect() {
    local wanted=$1 text=$2 code=0
    shift 2
    "$program" "$@" >"$work/talk" 2>&1 || code=$?
    [ "$code" = "$wanted" ] || complain "fragmark $*: exit code $code, not $wanted: $(tail -3 "$work/talk")"
    grep -q -- "$text" "$work/talk" || complain "fragmark $*: does not say '$text': $(tail -3 "$work/talk")"
}

printf 'methods: [kb, exact]\ndevices: [dummy]\nn: 4\nk: [2, 4]\nwidth_px: 16\nheight_px: 12\n' >"$work/my.yml"
"$program" run "$work/my.yml" -q --no-report -a launches=2 -o "$work/results" >/dev/null 2>&1
[ -e "$work/results/specs/my.yml" ] || complain "the spec was not kept"

# Each kind of archive holds the results, and nothing stays behind
for ending in .tar .tar.gz .tgz .tar.xz .tar.zst ''; do
    case $ending in *xz) command -v xz >/dev/null || continue ;; *zst) command -v zstd >/dev/null || continue ;; esac
    out="$work/a pack$ending"
    expect 0 'files' pack "$work/results" -o "$out"
    expect 0 'whole' verify "$out"
    grep -q 'another here' "$work/talk" && complain "differs from itself: $(cat "$work/talk")"
    expect 2 'already\|not empty' pack "$work/results" -o "$out"
done
tar -xf "$work/a pack.tar" -C "$work"
diff -r -x README -x pack.json "$work/results" "$work/a_pack" || complain "other files"
for text in 'fragmark run .*my.yml' 'kb.so' 'store.glsl' 'layers' 'dummy' 'governor'; do
    grep -q "$text" "$work/a_pack/README" || complain "README lacks $text"
done
id() {
    "$program" verify "$1" | sed -n 's/.*id //p'
}
[ "$(id "$work/a pack.tar")" = "$(id "$work/a pack")" ] || complain "two ids of one pack"
[ -z "$(ls "$TMPDIR")" ] || complain "left in TMPDIR: $(ls "$TMPDIR")"
[ -z "$(ls -d "$work"/*partial* 2>/dev/null)" ] || complain "left: $(ls -d "$work"/*partial*)"
(cd "$work" && "$program" pack results/ >/dev/null && [ -s results.tar.gz ]) || complain "no default output"
# A pack of an unpacked pack is the same results.
expect 0 'files' pack "$work/a_pack" -o "$work/again.tar"
expect 0 'whole' verify "$work/again.tar"

# Damage is named, all of it
cp -r "$work/a_pack" "$work/hurt"
printf x >>"$work/hurt/summary.csv"
rm "$work/hurt/samples.csv"
touch "$work/hurt/more.csv"
image=$(ls "$work/hurt/images" | head -1)
printf '\377' | dd of="$work/hurt/images/$image" bs=1 seek=40 conv=notrunc 2>/dev/null
ln -sf /etc/passwd "$work/hurt/journal.jsonl"
expect 8 'DAMAGED' verify "$work/hurt"
for text in 'damaged: summary.csv: [0-9]* bytes, not' 'missing: samples.csv' 'added: more.csv' \
    "damaged: images/$image: its content" 'damaged: journal.jsonl: is neither'; do
    grep -q "$text" "$work/talk" || complain "verify does not say '$text'"
done
tar -cf "$work/hurt.tar" -C "$work" hurt
expect 8 'missing: samples.csv' verify "$work/hurt.tar"
expect 8 '"is_whole": false' verify "$work/hurt.tar" --json
[ -L "$work/hurt/journal.jsonl" ] || complain "verify changed what it looked at"

# What is another here
mkdir -p "$work/methods"
for method in exact kb null common; do
    cp -rL "$(dirname "$program")/methods/$method" "$work/methods/"
done
echo '// mine' >>"$work/methods/kb/store.glsl"
FRAGMARK_PLUGIN_PATH=$work/methods expect 0 'another here: method kb: store.glsl' verify "$work/a pack"
cp -r "$work/a_pack" "$work/else"
sed -i 's/"cpu": "[^"]*"/"cpu": "Z80"/; s/"fragmark": "[^"]*"/"fragmark": "9.9.9"/; s/kb\.so/kc.so/' "$work/else/manifest.json"
expect 8 'another here: cpu: Z80' verify "$work/else"
for text in 'version: 9.9.9; here' 'method kc: is not here'; do
    grep -q "$text" "$work/talk" || complain "verify does not say '$text'"
done

# What is no pack
head -c 3000 "$work/a pack.tar.gz" >"$work/torn.tar.gz"
expect 8 'tar failed' verify "$work/torn.tar.gz"
expect 8 'tar failed' verify "$work/my.yml"
expect 8 'no pack' verify "$work/results"
expect 2 'No such file' verify "$work/nowhere.tar"
expect 2 'which PACK' verify
tar -cf "$work/two.tar" -C "$work" a_pack hurt
expect 8 'not one folder' verify "$work/two.tar"
cp -r "$work/a_pack" "$work/odd"
sed -i 's/"bytes": [0-9]*/"bytes": -1/' "$work/odd/pack.json"
expect 8 'a file of its list cannot be' verify "$work/odd"
echo '{"pack": 1}' >"$work/odd/pack.json"
expect 8 'not the list' verify "$work/odd"
echo '[' >"$work/odd/pack.json"
expect 8 'pack.json:' verify "$work/odd"
# A list that names files outside finds none of them.
sed 's#"path": "summary.csv"#"path": "../a_pack/summary.csv"#' "$work/a_pack/pack.json" >"$work/odd/pack.json"
expect 8 'missing: ../a_pack/summary.csv' verify "$work/odd"

# What cannot be packed
expect 2 'holds no results' pack "$work" -o "$work/x.tar"
expect 2 'No such file' pack "$work/nowhere" -o "$work/x.tar"
expect 5 'No such file' pack "$work/results" -o "$work/nowhere/x.tar"
[ ! -e "$work/x.tar" ] || complain "something was packed"
[ -z "$(ls "$TMPDIR")" ] || complain "left in TMPDIR: $(ls "$TMPDIR")"
exit "$failed"
