#!/usr/bin/env bash
# record_test.sh PROGRAM DEMO: `fragmark record`; what it says when a tool
# is missing. Skipped where the tools, which nothing else needs, are not installed.
set -euo pipefail
program=$1 demo=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
fail() { echo "$*"; cat "$work/log"; exit 1; }
for tool in apitrace glretrace Xvfb; do
    command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed (apitrace, xvfb)"; exit 77; }
done

record() { "$program" record "$@" >"$work/out" 2>"$work/log"; }
record --frames 12 --size 640x480 -o "$work/demo" -- "$demo" 16 || fail "no recording"
[ "$(cat "$work/out")" = "$work/demo.yml" ] || fail "stdout is not the scene"
grep -q "12 frames of 320 x 240 px, 1032 triangles" "$work/log" || fail "other counts"
grep -q " 12 of kinds that are not recorded" "$work/log" || fail "instances are not counted"
# The rasteriser's vertex arithmetic is the driver's: counts must agree, bytes may not.
[ "$(wc -c <"$work/demo.stream")" = "$(wc -c <scenes/frames/gl-demo.stream)" ] || fail "another size"
"$program" run --device tbr --scene "$work/demo.yml" --method tbr-base,tbr-re,tbr-evr-safe -a launches=1 \
    --no-report -o "$work/run" 2>"$work/log" || fail "no replay"

record -o "$work/demo" -- "$demo" && fail "an old recording was overwritten"
grep -q "demo.stream: exists" "$work/log" || fail "not why"
record -o "$work/none" -- true && fail "a program without OpenGL was recorded"
grep -q "apitrace saw no OpenGL call" "$work/log" || fail "not why"
rm -rf "$(sed -n 's|.*said: \(/tmp/fragmark-record-[^/]*\)/log|\1|p' "$work/log")"

PATH=/nonexistent "$program" record -o "$work/tool" -- "$demo" 2>"$work/log" && fail "ran without Xvfb"
grep -q "apt-get install xvfb" "$work/log" || fail "no package is named"
code=0
record -o "$work/tool" --size 0x5 -- "$demo" || code=$?
[ "$code" = 2 ] || fail "a wrong size is no usage error"
