#!/usr/bin/env bash
# bundle_test.sh PROGRAM: a bundle runs in a root that holds glibc and nothing else, under another path;
# and there is a whole bundle or none.
set -euo pipefail
program=$1
unshare --mount true 2>/dev/null && namespace=(unshare --mount) ||
    { unshare --map-root-user --mount true 2>/dev/null && namespace=(unshare --map-root-user --mount); } ||
    { echo "no mount namespace here"; exit 77; }
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
root=$here/root
failed=0

fail() {
    echo "FAILED: $1"
    sed 's/^/    /' "$here/out"
    failed=1
}

# want NAME CODE WORDS COMMAND...
want() {
    local name=$1 expected=$2 words=$3 code=0
    shift 3
    "$@" >"$here/out" 2>&1 </dev/null || code=$?
    [ "$code" -eq "$expected" ] || fail "$name: exit code $code, not $expected"
    grep -qF -- "$words" "$here/out" || fail "$name: '$words' is missing"
}

# Of glibc: the loader, and what the program itself asks for by name.
mkdir -p "$root/proc" "$root/tmp" "$root/dev"
ldd "$program" | grep -oE '/[^ ]*/(ld-linux[^ /]*|lib(c|m|dl|rt|pthread)\.so\.[0-9]+)' | sort -u |
    xargs cp -L --parents -t "$root"

want bundle_is_made 0 "methods, " "$program" bundle "$root/moved kit"
want bundle_is_not_made_twice 2 "is not empty" "$program" bundle "$root/moved kit"

# inside COMMAND...: in that root alone
inside() {
    "${namespace[@]}" sh -c 'mount --rbind /proc "$0/proc" && mount --rbind /dev "$0/dev" && root=$0 && exec env -i "$(command -v chroot)" "$root" "$@"' \
        "$root" "$@"
}
kit="/moved kit/bin/fragmark"
small=(-a n=4 -a width_px=16 -a height_px=16 -a frames=1 -a warmup=0 -a launches=1)
want methods_are_listed 0 kplus-array inside "$kit" list methods
want scenes_are_listed 0 hard/ulp inside "$kit" list scenes
want missing_library_is_told 0 "a bundle has none" inside "$kit" doctor
want report_is_told_missing 0 "a bundle has no fragmark-report" inside "$kit" doctor
want techniques_run 0 "2 ok" inside "$kit" run --device tbr --scene frames/gl-demo --method tbr-base,tbr-re \
    -a sequence_frames=2 -o /tmp/frames
want fragments_run 0 "1 ok" inside "$kit" run --device dummy --method z-buffer "${small[@]}" -o /tmp/dummy
want tables_are_made 0 "0 differ" inside "$kit" reproduce kplus-table1 -o /tmp/table

# Some methods: those, and the floors of feeds.
want some_methods_are_bundled 0 "methods, " "$program" bundle "$here/some" --methods kplus-array
[ -e "$here/some/lib/fragmark/methods/kplus-array/kplus-array.so" ] || fail "some_methods: kplus-array is missing"
[ -e "$here/some/lib/fragmark/methods/null/null.so" ] || fail "some_methods: the floor is missing"
[ ! -e "$here/some/lib/fragmark/methods/ab-ll/ab-ll.so" ] || fail "some_methods: ab-ll is there"

# A scene comes with its mesh, whatever its ending, and the files of that; or there is no bundle.
scenes=$here/scenes
mkdir -p "$scenes/mine"
printf 'generator: mesh\nmesh: A.OBJ\n' >"$scenes/mine/capitals.yml"
printf 'generator: mesh\nmesh: ../b.mesh\n' >"$scenes/mine/beside.yml"
touch "$scenes/mine/A.OBJ" "$scenes/b.mesh" "$scenes/c.gltf" "$scenes/c.BIN"
want meshes_are_bundled 0 "methods, " env FRAGMARK_SCENE_PATH="$scenes" "$program" bundle "$here/meshes" \
    --methods kplus-array
for file in mine/A.OBJ b.mesh c.gltf c.BIN; do
    [ -e "$here/meshes/share/fragmark/scenes/$file" ] || fail "meshes_are_bundled: $file is missing"
done
touch "$here/outside.obj"
printf 'generator: mesh\nmesh: ../outside.obj\n' >"$scenes/far.yml"
want mesh_outside_is_refused 2 "outside.obj" env FRAGMARK_SCENE_PATH="$scenes" "$program" bundle "$here/none" \
    --methods kplus-array
[ ! -e "$here/none" ] || fail "mesh_outside_is_refused: something is left"

# Nothing is left of what cannot be made.
want unknown_method_names_the_nearest 2 "the nearest is 'kplus-array'" "$program" bundle "$here/none" \
    --methods kplus-aray
mkdir "$here/small"
want full_disk_is_told 3 "MB are free" "${namespace[@]}" sh -c \
    'mount -t tmpfs -o size=4m none "$0" && "$@"; code=$?; ls -A "$0"; exit $code' "$here/small" \
    "$program" bundle "$here/small/kit"
grep -q partial "$here/out" && fail "full_disk: a part is left"
[ -z "$(find "$here" -maxdepth 1 -name '*partial*')" ] || fail "a part of a bundle is left"
exit "$failed"
