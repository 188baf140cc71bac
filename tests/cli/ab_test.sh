#!/usr/bin/env bash
# ab_test.sh PROGRAM SOURCE CC: `ab`, `gate` and `calibrate` on the dummy device, whose frames take as long as they
# take: outputs that are worse are named and end with exit code 1, equal ones with 0; a command that is killed
# continues and launches nothing twice; wrong arguments and files are refused with the nearest name.
set -euo pipefail
program=$1
source=$2
compiler=$3
methods=$(dirname "$program")/methods
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "ab_test: $*" >&2; exit 1; }
# The dummy's times are equal; its processor times are microseconds, which are not looked at closely.
small=(-q --no-images --calibration none --band 100% --device dummy -a n=4 -a k=2 -a width_px=16 -a height_px=12 -a frames=2 -a warmup=0)

# want CODE ARGUMENT...: what is printed is in $work/said, what it talks in $work/talk
want() {
    local expected=$1 code=0
    shift
    "$program" "$@" >"$work/said" 2>"$work/talk" || code=$?
    [ $code = "$expected" ] || fail "$*: exit code $code, not $expected: $(cat "$work/said" "$work/talk")"
}
says() { grep -qF -- "$1" "$work/said" "$work/talk" || fail "'$1' is not in: $(cat "$work/said" "$work/talk")"; }
# launches DIR SIDE: how many ended
launches() { grep -c '"event":"end"' "$work/$1/$2/journal.jsonl"; }

mkdir -p "$work/base" "$work/fat" "$work/broken" "$work/build/methods"
for folder in base fat broken build/methods; do cp -rL "$methods/kplus-heap" "$work/$folder/"; done
cp -rL "$methods/ab-array" "$work/base/"
cp -rL "$methods/ab-array" "$work/broken/"
# Eight more bytes a pixel.
sed 's/\.extent = { \.per_pixel_k = 1 }/.extent = { .per_pixel = 1, .per_pixel_k = 1 }/' "$source/methods/kplus-heap/method.c" >"$work/fat.c"
! cmp -s "$work/fat.c" "$source/methods/kplus-heap/method.c" || fail "kplus-heap is not as it was: the copy has no more bytes"
"$compiler" -shared -fPIC -fvisibility=hidden -I"$source/runner/include" -o "$work/fat/kplus-heap/kplus-heap.so" "$work/fat.c"
echo 'no shader' >"$work/broken/kplus-heap/store.glsl"
echo 'no plugin' >"$work/broken/kplus-heap/kplus-heap.so"

# Equal builds; a build's folder is one with methods/.
want 0 ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --pairs 6,8 -o "$work/equal" --csv "$work/equal.csv"
says '1 case: 0 worse'
cmp "$work/equal.csv" "$work/equal/ab.csv" || fail "--csv is not ab.csv"
pairs=$(launches equal base)
[ "$pairs" = "$(launches equal new)" ] || fail "not as many launches on both sides"
[ $((pairs + 1)) = "$(wc -l <"$work/equal/pairs.csv")" ] || fail "pairs.csv has other pairs than the journals"
first=$(tail -n +2 "$work/equal/pairs.csv" | cut -d, -f6 | sort | uniq -c | awk '{ print $1 }' | uniq | wc -l)
[ "$first" = 1 ] || fail "BASE and NEW are not first as often: $(cat "$work/equal/pairs.csv")"
# Again: nothing is launched, and the same is said.
want 0 ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --pairs 6,8 -o "$work/equal" --json
says '"outputs": "equal"'
says '"is_finished": true'
[ "$pairs" = "$(launches equal base)" ] || fail "a finished command launched again"
cmp "$work/equal.csv" "$work/equal/ab.csv" || fail "replayed launches are judged otherwise"
# Both sides are runs.
want 0 gate "$work/equal/base" "$work/equal/new"
says '1 case: 0 worse'
says 'times were not judged'

# More bytes: gate names them, and times nothing; ab goes on.
want 1 gate "$work/base" "$work/fat" "${small[@]}" --pairs 6,8 -o "$work/fatter"
grep '^worse .*kplus-heap .*bytes_allocated [0-9]* -> [0-9]*' "$work/said" >/dev/null || fail "the case is not named: $(cat "$work/said")"
says "left out: method 'ab-array' is in base alone"
[ "$(launches fatter new)" = 1 ] || fail "a case that is worse was timed"
grep -q 'bytes_allocated' "$work/fatter/ab.csv" || fail "ab.csv does not say so"
want 1 ab kplus-heap@"$work/base" kplus-heap@"$work/fat" "${small[@]}" --pairs 6,8 -o "$work/fat-ab"
[ "$(launches fat-ab new)" -ge 6 ] || fail "ab did not time it"
want 0 gate "$work/fat" "$work/base" "${small[@]}" --pairs 6,8 -o "$work/thinner" # and the other way round
want 1 gate "$work/fatter/base" "$work/fatter/new"
grep '^worse .*K+B-Heap.*bytes_allocated' "$work/said" >/dev/null || fail "results: the case is not named: $(cat "$work/said")"
want 0 gate "$work/fatter/new" "$work/fatter/base"
# The same as a table and as JSON.
want 1 gate "$work/fatter/base" "$work/fatter/new" --csv "$work/results.csv" --json
says '"verdict": "worse"'
says '"what": "bytes_allocated"'
! grep -q '"ratio"' "$work/said" || fail "times are in the JSON of a gate that does not judge them"
head -1 "$work/results.csv" | grep -q '^method,.*,status_new,verdict,.*,exact,other_code$' || fail "not its columns: $(head -1 "$work/results.csv")"
grep -q '^kplus-heap,.*,worse,.*bytes_allocated [0-9]* -> [0-9]*' "$work/results.csv" || fail "the case is not in it: $(cat "$work/results.csv")"
want 0 gate "$work/fatter/new" "$work/fatter/base" --csv "$work/results.csv"
grep -q '^kplus-heap,.*,differs,' "$work/results.csv" || fail "what is better is not told: $(cat "$work/results.csv")"
want 5 gate "$work/fatter/new" "$work/fatter/base" --csv "$work/none/results.csv"
want 2 gate "$work/fatter/base" "$work/fatter/new" --pairs 20
says 'of which nothing is measured'
# A plugin that is refused now.
want 1 gate "$work/base" "$work/broken" "${small[@]}" --pairs 6 -o "$work/refused"
grep '^worse .*kplus-heap .*plugin_error' "$work/said" >/dev/null || fail "a refused plugin is not worse: $(cat "$work/said")"
says '2 cases: 1 worse'
want 2 gate "$work/base" "$work/broken" --method kplus-heap "${small[@]}" --pairs 6 -o "$work/refused"
says 'is refused'

# A build that has its own program is measured by it: workers of this one say that they need more memory.
mkdir -p "$work/own/methods"
cp -rL "$methods/kplus-heap" "$methods/kplus-array" "$methods/common" "$work/own/methods/"
cat >"$work/own/fragmark" <<END
#!/bin/sh
[ "\$1" = worker ] || exec "$program" "\$@"
"$program" "\$@" || exit
sed -i 's/"bytes_allocated": /&9/' "\$3"
END
chmod +x "$work/own/fragmark"
want 1 ab kplus-heap@"$work/build" kplus-heap@"$work/own" "${small[@]}" --pairs 6 -o "$work/by-own"
grep '^worse .*bytes_allocated \([0-9]*\) -> 9\1' "$work/said" >/dev/null || fail "the other program is not seen: $(cat "$work/said")"
grep -qF "\"program\": \"$work/own/fragmark\"" "$work/by-own/new/manifest.json" || fail "new/manifest.json does not name its program"
grep -qF "\"program\": \"$(realpath "$program")\"" "$work/by-own/base/manifest.json" || fail "base/manifest.json does not name this program"
want 1 gate "$work/build" "$work/own" "${small[@]}" --pairs 6 -o "$work/gate-own"
want 0 ab kplus-heap@"$work/build" kplus-heap@"$work/own" "${small[@]}" --pairs 6 --program this -o "$work/by-this"
says '1 case: 0 worse'
want 2 ab kplus-heap@"$work/build" kplus-heap@"$work/own" "${small[@]}" --program that -o "$work/none"
# One of another version measures nothing.
version=$("$program" --version | sed 's/.* //')
other=$(echo "$version" | tr 0-8 1-9)
mkdir -p "$work/foreign"
cp -rL "$work/own/methods" "$work/foreign/"
LC_ALL=C sed "s/${version//./\\.}/$other/g" "$program" >"$work/foreign/fragmark"
chmod +x "$work/foreign/fragmark"
want 7 gate "$work/build" "$work/foreign" "${small[@]}" -o "$work/not-measured"
says "it is fragmark $other, and not $version"
says "$work/foreign/fragmark cannot measure for"
[ ! -e "$work/not-measured" ] || fail "something was measured by another version"
want 0 gate "$work/build" "$work/foreign" "${small[@]}" --pairs 6 --program this -o "$work/is-measured"
# Nor does one whose shaders are not there.
rm -r "$work/foreign/methods/common"
cp "$work/own/fragmark" "$work/foreign/"
want 2 gate "$work/build" "$work/foreign" "${small[@]}" -o "$work/none"
says 'has no common/prelude.glsl'

# Killed, then again: what ended stays.
"$program" ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --pairs 80 -o "$work/killed" >/dev/null 2>&1 &
parent=$!
for _ in $(seq 6000); do # a busy machine needs its time
    [ "$(cat "$work/killed/new/journal.jsonl" 2>/dev/null | grep -c '"event":"end"')" -lt 5 ] || break
    sleep 0.02
done
kill -KILL $parent
wait $parent 2>/dev/null || true
before=$(launches killed base)
[ "$before" -ge 4 ] && [ "$before" -lt 80 ] || fail "it was not killed in the middle: $before launches"
want 0 ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --pairs 80 -o "$work/killed"
for side in base new; do
    twice=$(grep '"event":"end"' "$work/killed/$side/journal.jsonl" | sed 's/.*"launch":\([0-9]*\).*/\1/' | sort | uniq -d)
    [ -z "$twice" ] || fail "$side: launches $twice were measured twice"
    [ "$(launches killed $side)" = 80 ] || fail "$side: $(launches killed $side) launches, not 80"
done
# Interrupted: it says so, and judges nothing.
"$program" ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --pairs 400 -o "$work/stopped" >"$work/said" 2>"$work/talk" &
parent=$!
for _ in $(seq 6000); do
    [ "$(cat "$work/stopped/new/journal.jsonl" 2>/dev/null | grep -c '"event":"end"')" -lt 3 ] || break
    sleep 0.02
done
kill -TERM $parent
code=0
wait $parent || code=$?
[ $code = 143 ] || fail "interrupted: exit code $code"
says 'nothing is judged yet'
for side in base new; do # neither run is told to be over
    ! grep -q '"ended": "' "$work/stopped/$side/manifest.json" || fail "the side $side says that it ended"
done

# A calibration is kept, read, and refused on another machine.
want 0 calibrate -q --pairs 20 --device dummy -a n=4 -a k=2 -a width_px=16 -a height_px=12 -a frames=2 -o "$work/state/here.json"
says 'changes count from'
want 0 ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --calibration "$work/state/here.json" --pairs 6 -o "$work/calibrated"
sed 's/"cores": [0-9]*/"cores": 12345/' "$work/state/here.json" >"$work/state/there.json"
want 2 ab kplus-heap@"$work/base" kplus-heap@"$work/build" "${small[@]}" --calibration "$work/state/there.json" -o "$work/none"
says 'another machine'
want 2 calibrate -q --pairs 20 --device dummy -a n=4 -a k=2 -a width_px=16 -a height_px=12 -a frames=2 -o "$work/state/there.json" --results "$work/refused-file"
says 'another machine'
[ ! -e "$work/refused-file" ] || fail "it measured for a file that it cannot add to"
XDG_STATE_HOME=$work/state want 0 calibrate -q --pairs 20 --device dummy -a n=4 -a k=2 -a width_px=16 -a height_px=12 -a frames=2
[ "$(find "$work/state/fragmark/calibration" -name '*.json' | wc -l)" = 1 ] || fail "the calibration is not in XDG_STATE_HOME"
# A kernel that counted a little more memory, as after another boot: it is the same machine, and its file.
kept=$(echo "$work"/state/fragmark/calibration/*.json)
bytes=$(grep -o '"memory_bytes": [0-9]*' "$kept" | grep -o '[0-9]*$')
sed -i "s/\"memory_bytes\": [0-9]*/\"memory_bytes\": $((bytes / 100 * 101))/" "$kept"
mv "$kept" "$work/state/fragmark/calibration/0123456789abcdef.json"
XDG_STATE_HOME=$work/state want 0 calibrate -q --pairs 20 --device dummy -a n=4,6 -a k=2 -a width_px=16 -a height_px=12 -a frames=2
says 'of these the noisiest case is kept: kplus-heap'
says 'calibration/0123456789abcdef.json'
[ "$(find "$work/state/fragmark/calibration" -name '*.json' | wc -l)" = 1 ] || fail "the machine has two calibrations"
grep -q "\"memory_bytes\": $bytes" "$work/state/fragmark/calibration/0123456789abcdef.json" || fail "the file is not this machine's"
echo '{' >"$work/state/fragmark/calibration/damaged.json"
XDG_STATE_HOME=$work/state want 2 ab kplus-heap@"$work/base" kplus-heap@"$work/build" -q --device dummy -a n=4 -o "$work/none"
says 'damaged.json:'

# A case that crashes on both sides while it runs: the others are judged, and it is named.
mkdir -p "$work/faulty/picky"
cat >"$work/picky.c" <<'EOF'
#include <signal.h>

#include "head.h"

static fm_next after(const fm_workload *workload, const char *pass)
{
    (void)pass;
    if (workload->width_px == 20)
        raise(SIGTRAP); /* which no sanitizer takes */
    return FM_NEXT;
}

const fm_method_desc fm_method = {
    HEAD("picky"),
    .resources = { NEAREST },
    .passes = { { .name = "clear", .kind = FM_PASS_CLEAR, .writes = { "nearest" }, .clear_word = 0x7F800000u },
                STORE, { .name = "ask", .kind = FM_PASS_HOST }, RESOLVE },
    .keeps = FM_KEEPS_NEAREST,
    .after = after,
};
EOF
"$compiler" -shared -fPIC -fvisibility=hidden -I"$source/runner/include" -I"$source/tests/plugins" \
    -o "$work/faulty/picky/picky.so" "$work/picky.c"
cp "$source"/tests/plugins/{store,resolve}.glsl "$work/faulty/picky/"
picky=(-q --device dummy -a n=4 -a height_px=12 -a frames=2)
want 4 ab picky@"$work/faulty" picky@"$work/faulty" "${picky[@]}" --calibration none --band 100% --no-images \
    -a width_px=16,20 --pairs 20 -o "$work/both-fail" --json
says '"unmeasured": 1'
says '"same": 1'
says '"status_base": "crash"'
says '"status_new": "crash"'
says 'SIGTRAP'
# calibrate leaves it out, and keeps the other one; if nothing is left, nothing is kept.
want 4 calibrate --method picky --plugin-dir "$work/faulty" "${picky[@]}" -a width_px=16,20 --pairs 20 -o "$work/state/picky.json"
says 'left out, for it was not measured: picky'
says 'SIGTRAP'
grep -q '"case": "picky.*width_px=16' "$work/state/picky.json" || fail "what was measured is not kept: $(cat "$work/state/picky.json")"
want 4 calibrate --method picky --plugin-dir "$work/faulty" "${picky[@]}" -a width_px=20 --pairs 20 -o "$work/state/nothing.json"
says 'nothing could be measured'
[ ! -e "$work/state/nothing.json" ] || fail "a calibration of nothing was kept"

# Results that cannot be continued end calibrate as they end ab.
again() { # CODE: both, with what lies in picky-results
    want "$1" calibrate --method picky --plugin-dir "$work/faulty" "${picky[@]}" -a width_px=16 --pairs 20 \
        -o "$work/state/picky.json" --results "$work/picky-results"
    want "$1" ab picky@"$work/faulty" picky@"$work/faulty" "${picky[@]}" --no-images -a width_px=16 --pairs 20 \
        -o "$work/picky-results"
}
want 0 calibrate --method picky --plugin-dir "$work/faulty" "${picky[@]}" -a width_px=16 --pairs 20 \
    -o "$work/state/picky.json" --results "$work/picky-results"
head -3 "$work/picky-results/base/journal.jsonl" >"$work/short" # one launch, which ended
cp "$work/short" "$work/picky-results/base/journal.jsonl"
echo '// other code' >>"$work/faulty/picky/resolve.glsl"
again 7
sed -i '2s/.*/no JSON/' "$work/picky-results/base/journal.jsonl"
again 8

# What cannot be.
want 2 ab kplus-heap@"$work/base" "${small[@]}"
want 2 ab kplus-heap "kplus-heap@$work/base" "${small[@]}"
says 'METHOD@DIR, please'
want 2 ab kplus-hepa@"$work/base" kplus-heap@"$work/base" "${small[@]}"
says "the nearest is 'kplus-heap'"
want 2 ab ab-ll@"$work/base" ab-ll@"$work/base" "${small[@]}" # the program's own is not meant
says "has no method 'ab-ll'"
want 2 ab kplus-heap@"$work/none" kplus-heap@"$work/base" "${small[@]}"
says 'No such file'
want 2 ab kplus-heap@"$work/base" kplus-heap@"$work/base" "${small[@]}" -a launches=3
says '--pairs'
want 2 ab kplus-heap@"$work/base" kplus-heap@"$work/base" "${small[@]}" --pairs 20,10
says 'at least 21'
want 2 ab kplus-heap@"$work/base" kplus-heap@"$work/base" "${small[@]}" --band none
want 2 gate "$work/base"
want 2 gate "$work/base" "$work/state"
says 'no plugin lies there'
for command in ab gate calibrate; do
    "$program" $command --help >"$work/said"
    grep -q "fragmark $command" "$work/said" && grep -q 'Examples:' "$work/said" || fail "$command --help has no examples"
done
echo "ab_test: passed"
