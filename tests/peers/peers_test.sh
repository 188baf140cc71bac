#!/usr/bin/env bash
# peers_test.sh PROGRAM PEERS: the opponents in the folder PEERS are as exact as methods: on layers of many kinds,
# some with ties, on both devices, on hard scenes and on a mesh. A time of theirs says something only then.
# Then compare.sh runs to its end, and every pair that can be measured has a ratio.
set -euo pipefail
program=$1
peers=$2
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
names=peer-array,peer-heap,peer-spinlock,peer-list,peer-s-buffer
count=5
hard=ends,coplanar,duplicates,k-less-1,k-plus-1,opaque,shells,one-pixel,no-layers,slivers

# rows ROWS OPTION...: a run of the opponents. There are so many rows, all of them ok: of methods that are declared
# exact that means no fragment missing, extra or misordered.
rows() {
    local expected=$1
    shift
    rm -rf "$work/out"
    "$program" run -q --no-report --no-images --plugin-dir "$peers" --method $names --device $devices \
        -a launches=1 -a frames=1 -a warmup=0 "$@" -o "$work/out" 2>"$work/talk" || true
    local found
    found=$(grep -c '^1,[0-9a-f]*,ok,' "$work/out/summary.csv") || true
    [ "$found" = "$expected" ] || {
        echo "$found rows are ok, not $expected: $*"
        cat "$work/talk"
        cut -d, -f3-5 "$work/out/summary.csv"
        exit 1
    }
}

devices=vulkan,osmesa
small=(-a width_px=37 -a height_px=23 -a pixel_density=0.8 -a tessellation=3)
rows $((2 * (4 * 4 + 1))) --scene layers "${small[@]}" -a n=40 -a k=1,2,8,33 -a order=random-cell \
    -a fragment_probability=0.6 # the S-buffer has no k
rows $((2 * count)) --scene layers "${small[@]}" -a n=24 -a k=8 -a depths=coplanar -a order=cell-major
rows $((2 * count)) --scene layers "${small[@]}" -a n=70 -a k=64 -a order=descending
devices=vulkan
rows $((count * 10)) --scene "$(sed 's|[^,]*|hard/&|g' <<<$hard)" -a k=8
rows $count --scene kplus-example -a k=4

FRAGMARK_PLUGIN_PATH=$peers:${FRAGMARK_PLUGIN_PATH:-} PEERS_QUICK=1 "$here/compare.sh" "$program" "$work/compared" \
    >/dev/null 2>"$work/talk" || { cat "$work/talk" && exit 1; }
awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) at[$i] = i; next }
    $at["scene"] == "interlock" { next } # where a device has one
    { rows++ }
    $at["status"] == "ok" && $at["peer_status"] == "ok" && $at["ratio"] > 0 { good++ }
    END { if (rows != good || rows < 30) { print rows " rows, " good " with a ratio"; exit 1 } }' \
    "$work/compared/ratios.csv" || { cat "$work/compared/ratios.csv" && exit 1; }
