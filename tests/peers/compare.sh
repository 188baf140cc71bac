#!/usr/bin/env bash
# compare.sh PROGRAM OUT [OPTION...]: our methods beside the opponents of this folder, each pair in one run.
# OUT/ratios.csv has a row for each pair, scene and k: how many times theirs our frame takes, with its interval
# (ratios.awk). OUT/SCENE is the run. OPTION goes to every run, after what stands here: -a layout=tile,
# -a launches=12.
#
# The program has to find the opponents. From a build folder:
#   FRAGMARK_PLUGIN_PATH=build/bench/tests/peers tests/peers/compare.sh build/bench/fragmark OUT
# A bundle takes them in, and finds them by itself; the two scripts go along:
#   build/bench/fragmark bundle DIR --plugin-dir build/bench/tests/peers
#   cp tests/peers/compare.sh tests/peers/ratios.awk DIR/
#   DIR/compare.sh DIR/bin/fragmark OUT        on the other machine
# PEERS_QUICK=1 is for trying the script: small pictures and meshes, few launches, no times worth reading.
set -euo pipefail
program=${1:?usage: compare.sh PROGRAM OUT [OPTION...]}
out=${2:?usage: compare.sh PROGRAM OUT [OPTION...]}
shift 2
here="$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)"

methods=kplus-array,kplus-heap,kb-mdt32,kb-mdt64,kb-ab-ll,s-buffer
peers=peer-array,peer-heap,peer-spinlock,peer-list,peer-s-buffer,loop32,loop64
usual=(-a timers=frame -a launches=6 -a frames=5 -a width_px=854 -a height_px=480)
layers=(-a n=128 -a tessellation=16 -a pixel_density=0.25)
ks=8,16,32,64 many=8,64 instances=48 dense=hairball
if [ "${PEERS_QUICK:-0}" = 1 ]; then
    usual=(-a timers=frame -a launches=2 -a frames=1 -a warmup=0 -a width_px=96 -a height_px=54)
    layers=(-a n=24 -a tessellation=4 -a pixel_density=0.25)
    ks=8 many=8 instances=2 dense=kplus-example
fi

# measure NAME OPTION...: OUT/NAME. A run that met failures (4) has its other rows all the same, and one that could
# measure nothing (3), such as interlock on a device without, has rows that say so.
measure() {
    local name=$1 status=0
    shift
    "$program" run --method "$methods,$peers" --no-report --no-images "${usual[@]}" "$@" -o "$out/$name" || status=$?
    case $status in 0 | 3 | 4) ;; *) exit "$status" ;; esac
}

mkdir -p "$out"
measure layers --scene layers "${layers[@]}" -a k=$ks "$@"
measure bunny --scene bunny -a k=8 "$@"
measure bunnies --scene bunny -a instances="$instances" -a 'instance_offset=0.016 0.004 0.01' -a k="$many" "$@"
measure "$dense" --scene "$dense" -a k=8 "$@"
# The opponent's interlock is its spin lock's code under the runner's interlock.
methods=kplus-array,kplus-heap peers=peer-spinlock
measure interlock --scene layers "${layers[@]}" -a k=$ks -a lock=interlock "$@"

for run in layers bunny bunnies "$dense" interlock; do
    awk -v run="$run" -f "$here/ratios.awk" "$out/$run/summary.csv" "$out/$run/samples.csv"
done | awk 'NR == 1 || !/^scene,/' >"$out/ratios.csv"
echo "$out/ratios.csv"
