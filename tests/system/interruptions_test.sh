#!/usr/bin/env bash
# interruptions_test.sh PROGRAM KILLS TERMS: one run, killed so often (SIGKILL of the parent) at random moments, then
# ended so often by SIGTERM to all its processes in either order, and continued each time, ends with the rows of
# a run that nobody disturbed. Nothing is left running.
set -euo pipefail
program=$1
kills=$2
terms=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
launches=$((3 + (kills + terms) / 3))
arguments=(run -q --no-report --method exact,kplus-array,ab-ll --scene layers --device vulkan -a n=8 -a k=4
    -a width_px=48 -a height_px=32 -a "launches=$launches" -a frames=2 -a warmup=0 --no-images)
failed=0
hits=0
RANDOM=7

# Rows without times, and without what the host was like.
deterministic() {
    sed 's/"[^"]*"/quoted/g' "$1/summary.csv" | awk -F, 'NR == 1 { for (i = 1; i <= NF; i++)
            if ($i !~ /_ms|times_floor|fragments_per_s|noisy|message/) kept[++count] = i }
        { for (i = 1; i <= count; i++) printf "%s,", $kept[i]; print "" }'
}

# All processes of the session of the run
processes() { ps -s "$1" -o pid= 2>/dev/null || true; }

# disturb HOW: starts the run in a session of its own, disturbs it once it is at work, and waits for its end
disturb() {
    local code=0 parent
    setsid "$program" "${arguments[@]}" -o "$work/out" 2>>"$work/talk" &
    parent=$!
    sleep "$((RANDOM % 2)).$((RANDOM % 900 + 100))"
    case $1 in
    kill) kill -KILL "$parent" 2>/dev/null || true ;;
    worker-first) kill -TERM $(processes "$parent" | sort -rn) 2>/dev/null || true ;;
    parent-first) kill -TERM $(processes "$parent" | sort -n) 2>/dev/null || true ;;
    esac
    wait "$parent" 2>/dev/null || code=$?
    [ "$code" -eq 0 ] || hits=$((hits + 1))
    local wanted=143
    [ "$1" != kill ] || wanted=137
    if [ "$code" -ne 0 ] && [ "$code" -ne "$wanted" ]; then
        echo "$1: exit code $code: $(tail -3 "$work/talk")"
        failed=1
    fi
    for _ in $(seq 100); do
        [ -n "$(processes "$parent")" ] || return 0
        sleep 0.1
    done
    echo "$1: left running: $(ps -s "$parent" -o pid=,args=)"
    failed=1
}

"$program" "${arguments[@]}" -o "$work/undisturbed" 2>"$work/talk"
for _ in $(seq "$kills"); do disturb kill; done
for i in $(seq "$terms"); do
    if [ $((i % 2)) -eq 0 ]; then disturb parent-first; else disturb worker-first; fi
done
"$program" "${arguments[@]}" -o "$work/out" 2>>"$work/talk" || {
    echo "the last run: exit code $?: $(tail -3 "$work/talk")"
    failed=1
}
echo "disturbed $hits times of $((kills + terms))"
if [ "$hits" -lt $(((kills + terms) / 2)) ]; then
    echo "too few: the run was over before"
    failed=1
fi
deterministic "$work/undisturbed" >"$work/expected"
deterministic "$work/out" >"$work/got"
diff "$work/expected" "$work/got" || failed=1
exit "$failed"
