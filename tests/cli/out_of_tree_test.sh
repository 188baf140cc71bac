#!/usr/bin/env bash
# out_of_tree_test.sh BUILD CMAKE: installs BUILD into a folder of its own, builds the template that is
# installed with it (tests/out_of_tree), and runs it with the installed program.
set -euo pipefail
build=$1
cmake=$2
temporary=$(mktemp -d)
trap 'rm -rf "$temporary"' EXIT
# The installed program must find its own files, not those of this tree.
unset FRAGMARK_PLUGIN_PATH FRAGMARK_SCENE_PATH FRAGMARK_SOURCE_DIR

prefix=$temporary/prefix
"$cmake" --install "$build" --prefix "$prefix" >/dev/null
# A copy: nothing may lead from the plugin back into this tree.
cp -r "$prefix/share/fragmark/template" "$temporary/plugin"
"$cmake" -S "$temporary/plugin" -B "$temporary/build" -DCMAKE_PREFIX_PATH="$prefix" >/dev/null
"$cmake" --build "$temporary/build" >/dev/null
plugins=$temporary/build/methods

"$prefix/bin/fragmark" list methods --plugin-dir "$plugins" >"$temporary/methods"
grep -q 'nearest-lock' "$temporary/methods" || {
    echo "list methods does not name nearest-lock:"
    cat "$temporary/methods"
    exit 1
}
grep -q 'kplus-array' "$temporary/methods" || {
    echo "list methods does not name the installed kplus-array:"
    cat "$temporary/methods"
    exit 1
}

"$prefix/bin/fragmark" run --plugin-dir "$plugins" --method nearest-lock,nearest-list --scene layers -a n=4 \
    -a width_px=64 -a height_px=48 -a launches=1 -a frames=5 -o "$temporary/out"
for method in nearest-lock nearest-list; do
    grep -q ",ok,.*,$method," "$temporary/out/summary.csv" || {
        echo "summary.csv has no row of $method that is ok:"
        cat "$temporary/out/summary.csv"
        exit 1
    }
done

"$prefix/bin/fragmark" run --plugin-dir "$plugins" --device tbr --scene frames/gl-demo --no-report \
    --method tbr-base,tbr-depth-last -o "$temporary/frames"
grep -q ',ok,.*,tbr-depth-last,' "$temporary/frames/summary.csv" || {
    echo "summary.csv has no row of tbr-depth-last that is ok:"
    cat "$temporary/frames/summary.csv"
    exit 1
}
