#!/usr/bin/env bash
# truth_keys_test.sh PROGRAM [PAIRS]: truth hangs on scene, device and feed alone. Each key of a case, as
# `run --help` lists them, is set to each of its values, then PAIRS times (10) two keys at random: truth's
# digest stays what it is at the defaults, and methods that are declared exact are. More methods are asked
# where PAIRS is given.
set -euo pipefail
export FRAGMARK_CACHE=off # what is remembered says nothing of the keys
program=$1
pairs=${2:-10}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
runs=0
RANDOM=20

# settings_of_keys: KEY=VALUE, one a line, for every value that help names but the default
settings_of_keys() {
    "$program" run --help | awk '
        /^Keys of / { is_case = /of a case/; next }
        !is_case { next }
        /^  [a-z]/ { key = $1 }
        $NF ~ /^\(.*\)$/ && NF == 2 && /^   / {
            usual = substr($2, 2, length($2) - 2)
            if (split($1, ends, /\.\./) == 2)
                $1 = ends[1] "|" ends[1] + 1 "|" usual + 3 "|" ends[2]
            count = split($1, values, "|")
            for (i = 1; i <= count; i++)
                if (values[i] != usual)
                    print key "=" values[i]
        }'
}
mapfile -t settings < <(settings_of_keys)
if [ "${#settings[@]}" -lt 20 ]; then
    echo "only ${#settings[@]} settings were read from the help"
    exit 1
fi

scenes=('-a n=24 -a fragment_probability=0.6' '-a n=24 -a depths=coplanar' '-a n=24 -a depths=sloped')
methods=exact,kplus-array,tile-k,wboit
[ $# -lt 2 ] || methods=$methods,kplus-heap,kb-mdt64,ab-ll,s-buffer
declare -A truths

# try DEVICE FEED SCENE [SETTING...]: one run; compares with the run of the same place without settings
try() {
    local device=$1 feed=$2 scene=$3 place digest
    shift 3
    local -a arguments=()
    for setting in "$@"; do
        arguments+=(-a "$setting")
    done
    case " $*" in # without culling its keys matter to nobody
    *' culling='*) ;;
    *' cull_'*) arguments+=(-a culling=occupancy) ;;
    esac
    rm -rf "$work/out"
    # shellcheck disable=SC2086 # a scene is several words
    "$program" run -q --no-report --no-images --method $methods --scene layers --device "$device" \
        --feed "$feed" $scene -a width_px=16 -a height_px=12 -a launches=1 -a frames=1 -a warmup=0 \
        "${arguments[@]}" -o "$work/out" 2>"$work/talk" || true
    runs=$((runs + 1))
    place="$device $feed $scene"
    if ! [ -f "$work/out/summary.csv" ]; then
        echo "$place $*: nothing was run: $(cat "$work/talk")"
        failed=1
        return
    fi
    if tail -n +2 "$work/out/summary.csv" | cut -d, -f3 | grep -qv '^\(ok\|not_supported\)$'; then
        echo "$place $*: $(grep -v ',ok,\|,not_supported,\|^schema' "$work/out/summary.csv" | cut -d, -f3-5)"
        failed=1
    fi
    digest=$(grep ',truth_digest,' "$work/out/samples.csv" | cut -d, -f7 | sort -u || true)
    if [ $# -eq 0 ]; then
        truths[$place]=$digest
        [ -n "$digest" ] || { echo "$place: no truth"; failed=1; }
    elif [ -n "$digest" ] && [ "$digest" != "${truths[$place]}" ]; then
        echo "$place $*: truth is $digest, with the defaults it is ${truths[$place]}"
        failed=1
    fi
}

for device in vulkan osmesa; do
    "$program" list devices | grep -q "^$device" || continue
    for scene in "${scenes[@]}"; do
        for feed in raster compute-pixel triangles; do
            try "$device" "$feed" "$scene"
        done
    done
    for setting in "${settings[@]}"; do
        try "$device" raster "${scenes[0]}" "$setting"
    done
    for ((i = 0; i < pairs; i++)); do
        feeds=(raster compute-pixel triangles)
        one=${settings[RANDOM % ${#settings[@]}]}
        other=$one
        while [ "${other%%=*}" = "${one%%=*}" ]; do
            other=${settings[RANDOM % ${#settings[@]}]}
        done
        try "$device" "${feeds[RANDOM % 3]}" "${scenes[RANDOM % 3]}" "$one" "$other"
    done
done
echo "$runs runs, ${#settings[@]} settings"
exit "$failed"
