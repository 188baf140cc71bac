#!/usr/bin/env bash
# fresh_test.sh PROGRAM: a run is not continued with other code. A run is killed after its first launch;
# then a shader, a plugin or the program is another one. The same command says what changed, also with
# -q, ends with exit code 7, and leaves all files as they were. With --fresh it measures anew what the
# change concerns, and nothing else.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0

# A copy of the program beside copies of plugins and GLSL, all of which may be edited.
mkdir -p "$work/bin/methods"
cp "$program" "$work/bin/fragmark"
for method in ab-array kplus-array null common; do
    cp -rL "$(dirname "$program")/methods/$method" "$work/bin/methods/"
done
export FRAGMARK_SCENE_PATH FRAGMARK_PLUGIN_PATH="$work/bin/methods"
FRAGMARK_SCENE_PATH=$(cd "$(dirname "$program")/scenes" && pwd)
arguments=(--no-report --no-images --method ab-array,kplus-array --device dummy -a n=4 -a width_px=16
    -a height_px=12 -a frames=1 -a warmup=0)

complain() {
    echo "$*"
    failed=1
}

# run FOLDER ARGUMENT...: the exit code is in $code, what it said in $work/talk
run() {
    local folder=$1
    shift
    code=0
    "$work/bin/fragmark" run "${arguments[@]}" -o "$folder" "$@" >"$work/talk" 2>&1 || code=$?
}

forgotten() { # FOLDER METHOD: how often its row was begun anew
    local id
    id=$(grep ",$2," "$1/summary.csv" | cut -d, -f2)
    grep -c "{\"event\":\"forget\",\"case\":\"$id\"}" "$1/journal.jsonl" || true
}

# The first launch of two; the parent is killed in the second, as its worker begins. It may end before
# the signal comes; then it is tried again.
kill_after_first() {
    local folder=$1 parent
    for _ in $(seq 30); do
        rm -rf "$folder"
        "$work/bin/fragmark" run -q "${arguments[@]}" -a launches=2 -o "$folder" >/dev/null 2>&1 &
        parent=$!
        while kill -0 "$parent" 2>/dev/null &&
            [ "$(cat "$folder/journal.jsonl" 2>/dev/null | grep -c '"event":"end"')" -lt 2 ]; do
            sleep 0.01
        done
        kill -KILL "$parent" 2>/dev/null || true
        wait "$parent" 2>/dev/null || return 0
    done
    echo "fresh_test: it always ended before it was killed"
    exit 1
}

# refused FOLDER NAME ARGUMENT...: exit code 7, the name of what changed, and no file touched
refused() {
    local folder=$1 name=$2 before after
    shift 2
    before=$(cd "$folder" && find . -type f -exec md5sum {} + | sort)
    for quiet in -q --no-images; do
        run "$folder" "$quiet" "$@"
        [ "$code" -eq 7 ] || complain "$name: exit code $code, not 7: $(cat "$work/talk")"
        grep -q "other code.*$name" "$work/talk" || complain "$name is not named: $(cat "$work/talk")"
    done
    after=$(cd "$folder" && find . -type f -exec md5sum {} + | sort)
    [ "$before" = "$after" ] || complain "$name: files changed: $(diff <(echo "$before") <(echo "$after"))"
}

# renewed FOLDER NAME TIMES-AB-ARRAY TIMES-KPLUS-ARRAY ARGUMENT...: --fresh says, also with -q, the name of
# what changed; both rows are ok, and so often each was begun anew in all
renewed() {
    local folder=$1 name=$2 wanted="$3 $4" got
    shift 4
    run "$folder" -q --fresh "$@"
    [ "$code" -eq 0 ] || complain "--fresh: exit code $code: $(cat "$work/talk")"
    grep -q "other code.*$name" "$work/talk" || complain "--fresh: $name is not named: $(cat "$work/talk")"
    [ "$(grep -c ',ok,' "$folder/summary.csv")" -eq 2 ] || complain "--fresh: $(cat "$folder/summary.csv")"
    got="$(forgotten "$folder" ab-array) $(forgotten "$folder" kplus-array)"
    [ "$got" = "$wanted" ] || complain "rows were begun anew $got times, not $wanted"
}

# A shader, between two launches of a row
kill_after_first "$work/killed"
echo '// edited' >>"$work/bin/methods/kplus-array/store.glsl"
refused "$work/killed" store.glsl -a launches=2
renewed "$work/killed" store.glsl 0 1 -a launches=2

# The same, after the run was done
run "$work/done" -a launches=1
echo '// edited' >>"$work/bin/methods/kplus-array/resolve.glsl"
refused "$work/done" resolve.glsl -a launches=1
renewed "$work/done" resolve.glsl 0 1 -a launches=1

# The runner's GLSL, which both read
echo '// edited' >>"$work/bin/methods/common/emit.glsl"
refused "$work/done" common/emit.glsl -a launches=1
renewed "$work/done" common/emit.glsl 1 2 -a launches=1

# A plugin, and the floor, on which all ratios rest
echo >>"$work/bin/methods/ab-array/ab-array.so"
refused "$work/done" ab-array.so -a launches=1
renewed "$work/done" ab-array.so 2 2 -a launches=1
echo >>"$work/bin/methods/null/null.so"
refused "$work/done" null.so -a launches=1

# The program
echo >>"$work/bin/fragmark"
refused "$work/done" '(program, plugin: null.so)' -a launches=1
renewed "$work/done" '(program, plugin: null.so)' 3 3 -a launches=1
run "$work/done" -q -a launches=1
[ "$code" -eq 0 ] || complain "nothing changed, and the exit code is $code: $(cat "$work/talk")"
columns=$(sed 's/"[^"]*"/quoted/g' "$work/done/summary.csv" | awk -F, '
    NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    END { print $at["code_program"] "," $at["code_driver"] "," $at["code_plugin"] "," $at["code_shaders"] }')
[[ "$columns" =~ ^[0-9a-f]{16},[0-9a-f]{16},[0-9a-f]{16},[0-9a-f]{16}$ ]] ||
    complain "the row's code is '$columns'"
exit "$failed"
