#!/usr/bin/env bash
# large_test.sh PROGRAM REPORT MAKE_RESULTS: 100 000 cases are planned, and their journal is read again,
# and 20 000 rows are reported, each in seconds of processor time and within the memory named here.
# FM_LARGE_TIMES makes the seconds more, for builds without optimisation.
set -uo pipefail
program=$1 report=$2 make_results=$3
times=${FM_LARGE_TIMES:-1}
here=$(mktemp -d)
trap 'rm -rf "$here"' EXIT
failed=0
axes=(--device dummy --method kplus-array -a n=1:1000:+1 -a k=1:100:+1 -a width_px=16 -a height_px=16
    -a launches=1 -a frames=1 -a warmup=0)
command -v /usr/bin/time >/dev/null || { echo "skipped: needs the package time"; exit 77; }

# within NAME SECONDS KIB CODE COMMAND...
within() {
    local name=$1 seconds=$2 kib=$3 expected=$4
    shift 4
    /usr/bin/time -f '%U %S %M' -o "$here/time" "$@" >"$here/out" 2>"$here/talk" </dev/null
    local code=$?
    read -r user system most < <(tail -1 "$here/time")
    echo "$name: $user s user, $system s system, $most KiB, exit code $code"
    if [ "$code" -ne "$expected" ]; then
        tail -3 "$here/talk"
        failed=1
    fi
    if ! awk -v u="$user" -v s="$system" -v limit="$seconds" -v times="$times" \
        'BEGIN { exit !(u + s <= limit * times) }' || [ "$most" -gt "$kib" ]; then
        echo "FAILED: $name: $seconds s and $kib KiB are allowed"
        failed=1
    fi
}

within plan 10 512000 0 "$program" plan -q "${axes[@]}"
[ "$(wc -l <"$here/out")" -eq 100000 ] || { echo "FAILED: not 100000 cases"; failed=1; }
within plan_as_json 20 512000 0 "$program" plan -q --json "${axes[@]}"

# A run that is stopped leaves the plan's line; the ends of all cases are put behind it.
run=("$program" run -q --no-report --no-images "${axes[@]}" -o "$here/run")
"${run[@]}" >"$here/out" 2>&1 &
for _ in $(seq 600); do
    [ -s "$here/run/summary.csv" ] && break
    sleep 0.2
done
kill -TERM $!
wait $!
sed -n 1p "$here/run/journal.jsonl" >"$here/journal"
"$program" plan -q "${axes[@]}" | awk '{
    printf "{\"event\":\"end\",\"case\":\"%s\",\"launch\":0,\"result\":", $1
    print "{\"status\":\"not_supported\",\"message\":\"no\"}}"
}' >>"$here/journal"
mv "$here/journal" "$here/run/journal.jsonl"
# They say nothing of the code that they were measured by: all are read, compared and refused.
within replay 30 2000000 7 "${run[@]}"
[ "$(wc -l <"$here/run/summary.csv")" -eq 100001 ] || { echo "FAILED: rows are missing"; failed=1; }

for group in 200 20000; do # in 100 workloads, in one
    "$make_results" "$here/results-$group" 20000 "$group"
    within "report_of_$group" 10 1000000 0 "$report" "$here/results-$group" --reference none
done
exit $failed
