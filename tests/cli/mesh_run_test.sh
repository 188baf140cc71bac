#!/usr/bin/env bash
# mesh_run_test.sh PROGRAM: what a mesh holds is told once and kept, and both ways to rasterise it see the same.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
short=(-a width_px=48 -a height_px=36 -a launches=1 -a frames=1 -a warmup=0 -a k=8)

# complain WHAT: prints it, and the test fails
complain() {
    echo "$1"
    failed=1
}

# scene NAME FILE [LINE...]: a scene of a mesh
scene() {
    printf 'generator: mesh\nmesh: %s\n' "$2" >"$work/$1.yml"
    [ $# -le 2 ] || printf '%s\n' "${@:3}" >>"$work/$1.yml"
}

# tetrahedron FILE SIZE [PLACE]: an OBJ
tetrahedron() {
    local x=${3:-0}
    printf 'v %s 0 0\nv %s 0 0\nv %s %s 0\nv %s 0 %s\nf 1 2 3\nf 1 2 4\nf 2 3 4\nf 3 1 4\n' \
        "$x" "$(awk "BEGIN { printf \"%.17g\", $x + $2 }")" "$x" "$2" "$x" "$2" >"$work/$1"
}

# fragments FOLDER: of the only case
fragments() {
    local column
    column=$(head -1 "$1/summary.csv" | tr ',' '\n' | grep -n '^fragments_generated$' | cut -d: -f1)
    tail -1 "$1/summary.csv" | sed 's/"[^"]*"//g' | cut -d, -f"$column"
}

# expect_agreement SCENE: both feeds are ok, and see as many fragments, and some
expect_agreement() {
    local raster triangles
    "$program" run -q --no-report --method exact --scene "$work/$1.yml" "${short[@]}" -o "$work/$1-r" \
        2>"$work/talk" || complain "$1, raster: $(cat "$work/talk")"
    "$program" run -q --no-report --method tile-k --feed triangles --scene "$work/$1.yml" "${short[@]}" \
        -o "$work/$1-t" 2>"$work/talk" || complain "$1, triangles: $(cat "$work/talk")"
    raster=$(fragments "$work/$1-r")
    triangles=$(fragments "$work/$1-t")
    [ "$raster" = "$triangles" ] && [ "$raster" -gt 0 ] ||
        complain "$1: $raster fragments of feed raster, $triangles of feed triangles"
}

printf 'ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n%s' \
    $'property uchar red\nelement tristrips 1\nproperty list int int vertex_indices\nend_header\n' \
    >"$work/strip.ply"
printf '0 0 0 9\n1 0 0 9\n0 1 0 9\n1 1 0 9\n4 0 1 2 3\n' >>"$work/strip.ply"
scene strip strip.ply
told="$work/strip.ply: PLY, 2 triangles in 1 part, box 0 0 0 to 1 1 0; ignored: colours of vertices"

"$program" plan --method exact,kb --scene "$work/strip.yml" >/dev/null 2>"$work/talk"
[ "$(grep -cF "$told" "$work/talk")" = 1 ] || complain "plan: $(cat "$work/talk")"
"$program" plan -q --method exact --scene "$work/strip.yml" >/dev/null 2>"$work/talk"
! grep -qF "$told" "$work/talk" || complain "plan -q tells"
"$program" run --no-report --method exact --scene "$work/strip.yml" "${short[@]}" -a alpha=0.2,0.5 \
    -o "$work/told" >/dev/null 2>"$work/talk" || complain "run: $(cat "$work/talk")"
[ "$(grep -cF "$told" "$work/talk")" = 1 ] || complain "run: $(cat "$work/talk")"
grep -qF '"triangles": 2' "$work/told/manifest.json" || complain "manifest.json has no triangles"

expect_agreement strip
tetrahedron huge.obj 1e30
scene huge huge.obj
expect_agreement huge
tetrahedron tiny.obj 1e-8
scene tiny tiny.obj
expect_agreement tiny
tetrahedron far.obj 0.125 4649776.25
scene far far.obj 'eye: "4649776.3125 0.0625 0.5"' 'target: "4649776.3125 0.0625 0"'
expect_agreement far

scene away huge.obj 'eye: "0 0 1e60"'
"$program" run -q --no-report --method exact --scene "$work/away.yml" "${short[@]}" -o "$work/away" \
    2>"$work/talk" && complain "an eye at 1e60 is accepted"
grep -q 'eye: .* times the mesh.s size away' "$work/talk" || complain "away: $(cat "$work/talk")"
exit $failed
