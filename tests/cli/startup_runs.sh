#!/bin/bash
# Where the time of a run goes, and what a cache saves. The run is the usual one of four methods: every key at
# its default, with report and images. Each round has a run of each kind, in an order that turns: of another
# build if one is named, without a cache, with an empty one, with a full one. No test, because it says as much of
# the machine as of fragmark. It takes minutes, on a machine that does nothing else.
#   startup_runs.sh FRAGMARK [OTHER [ROUNDS [ARGUMENT...]]]      no other, 5 rounds, the run above; OTHER may be -
# Of the other build nothing but its time is read; it takes its own cache, in a folder of its own.
program=$(readlink -f "${1:?the program fragmark}")
other=${2:--} rounds=${3:-5}
shift $(($# < 3 ? $# : 3))
if [ $# -gt 0 ]; then run=("$@"); else run=(--method "kplus-heap,kplus-array,kb,ab-ll"); fi
kinds=(none cold warm)
[ "$other" = - ] || kinds=(other "${kinds[@]}")
[ "$other" = - ] || other=$(readlink -f "$other")
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT

TIMEFORMAT="%R %U %S"
one() { # KIND NAME: a run, its seconds, and its folder
    local cache=$work/full from=$program
    case $1 in
    other) from=$other cache=$work/others ;;
    none) cache=off ;;
    cold) cache=$work/empty && rm -rf "$cache" ;;
    esac
    rm -rf "$work/$2"
    { time FRAGMARK_CACHE=$cache "$from" run -q "${run[@]}" -o "$work/$2" >"$work/log" 2>&1; } 2>"$work/time" ||
        { cat "$work/log" && exit 1; }
    echo "$1 $(cat "$work/time")" >>"$work/seconds"
}

for kind in "${kinds[@]}"; do # nobody's first run counts
    one "$kind" first
done
: >"$work/seconds"
for round in $(seq "$rounds"); do
    for i in "${!kinds[@]}"; do
        kind=${kinds[(i + round) % ${#kinds[@]}]}
        one "$kind" "$kind"
        grep '^1,[^,]*,[^,]*,[0-9]*,,launch\.' "$work/$kind/samples.csv" 2>/dev/null |
            awk -F, -v kind="$kind" '{ sum[$6] += $7 } END { for (part in sum) print kind, part, sum[part] / 1000 }' \
                >>"$work/parts"
    done
done
sort -k1,1 -k2,2g "$work/seconds" | awk '
    { x[$1, ++n[$1]] = $2; cpu[$1] += $3 + $4 }
    function median(k) { return n[k] % 2 ? x[k, (n[k] + 1) / 2] : (x[k, n[k] / 2] + x[k, n[k] / 2 + 1]) / 2 }
    END {
        base = median("other" in n ? "other" : "none")
        for (k in n)
            printf "%-6s median %.2f s (%.2f to %.2f, %d runs), ratio %.3f; processors %.2f s, mean\n", k, median(k),
                x[k, 1], x[k, n[k]], n[k], median(k) / base, cpu[k] / n[k]
    }'
echo "seconds of a run by part, means; rest: the process of the run itself, truths, report"
awk '
    NR == FNR { seconds[$1] += $2; runs[$1]++; next }
    { sum[$1, $2] += $3; parts[$2]; launches[$1] += $3 }
    END {
        for (k in runs) {
            printf "%-6s", k
            for (p in parts)
                if ((k, p) in sum)
                    printf " %s %.2f", substr(p, 8, length(p) - 10), sum[k, p] / runs[k]
            printf " rest %.2f\n", (seconds[k] - launches[k]) / runs[k]
        }
    }' "$work/seconds" "$work/parts"
