#!/usr/bin/env bash
# installed_test.sh BUILD CMAKE SOURCE: installs BUILD, moves the prefix elsewhere, hides the source tree
# with the build, and wants all that the programs read to be found from their own place.
set -euo pipefail
build=$1 cmake=$2 source=$3
if [ "${4-}" != hidden ]; then
    unshare --mount true 2>/dev/null && namespace=(unshare --mount) ||
        { unshare --map-root-user --mount true 2>/dev/null && namespace=(unshare --map-root-user --mount); } ||
        { echo "no mount namespace here"; exit 77; }
    here=$(mktemp -d)
    trap 'rm -rf "$here"' EXIT
    cp "${BASH_SOURCE[0]}" "$here/test.sh"
    "$cmake" --install "$build" --prefix "$here/prefix" >/dev/null
    mkdir "$here/moved here"
    mv "$here/prefix" "$here/moved here/fragmark"
    cd "$here"
    "${namespace[@]}" bash "$here/test.sh" "$build" "$cmake" "$source" hidden
    exit
fi

# In the namespace: nothing of the tree can be seen.
mount -t tmpfs none "$source"
[ ! -e "$build" ] || mount -t tmpfs none "$build"
for variable in PLUGIN SCENE FIGURE REFERENCE RECORDER; do unset "FRAGMARK_${variable}_PATH"; done
bin="$PWD/moved here/fragmark/bin"
small=(-a n=4 -a width_px=16 -a height_px=16 -a frames=1 -a warmup=0 -a launches=1)

# want NAME WORDS COMMAND...: the command succeeds, and says WORDS
want() {
    local name=$1 words=$2
    shift 2
    "$@" >out 2>&1 || { echo "$name: exit code $?"; cat out; exit 1; }
    grep -qF -- "$words" out || { echo "$name: '$words' is missing"; cat out; exit 1; }
}

want methods_are_listed kplus-array "$bin/fragmark" list methods
want scenes_are_listed hard/ulp "$bin/fragmark" list scenes
want figures_are_listed kplus-05 "$bin/fragmark" list figures
want doctor_knows_its_place "$bin" "$bin/fragmark" doctor
want a_run_measures "1 ok" "$bin/fragmark" run --device dummy --method z-buffer "${small[@]}" --no-report -o run
if [ -x "$bin/fragmark-report" ]; then
    want a_table_is_judged "claims, stated: " "$bin/fragmark" reproduce kplus-table1 --smoke -o table
    grep -q '^KP-20,.*,holds,' table/claims.csv || { echo "KP-20 is not judged"; exit 1; }
    cp table/claims.csv judged.csv
    want a_report_is_made_again report.html "$bin/fragmark" report table
    cmp table/claims.csv judged.csv
    want a_reference_is_found report.html "$bin/fragmark" report table --reference h100
fi
