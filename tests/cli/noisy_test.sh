#!/bin/bash
# On a machine that is kept busy, rows are marked, and the end of the run and the report say so.
# Arguments: the program fragmark.
program=$1
[ -r /proc/self/schedstat ] || exit 77 # this system does not tell how long threads wait
work=$(mktemp -d) || exit 1
busy=()
stop() {
    kill "${busy[@]}" 2>/dev/null
    rm -rf "$work"
}
trap stop EXIT
failed=0
complain() {
    echo "$1"
    failed=1
}

for _ in $(seq $((3 * $(nproc)))); do
    while :; do :; done &
    busy+=($!)
done
"$program" run --method kplus-array --scene layers -a n=32 -a k=8 -a width_px=107 -a height_px=60 -a launches=3 \
    -a frames=2 -a warmup=1 --no-images -q -o "$work/out" >/dev/null 2>"$work/talk" || complain "the run failed"
grep -q 'NOISY: 1 of the rows.*load average' "$work/talk" || complain "the end of the run does not say it"
tail -n 1 "$work/out/summary.csv" | grep -q ',threads waited for a processor [0-9]* % of the time' ||
    complain "the row is not marked"
for metric in launch_cpu_s timed_s timed_cpu_s waited_s others_cpu_s involuntary_switches load_begin load_end; do
    for launch in 0 1 2; do
        grep -q ",$launch,,$metric,[0-9]" "$work/out/samples.csv" || complain "launch $launch has no $metric"
    done
done
if [ -x "$(dirname "$program")/fragmark-report" ]; then
    grep -q '1 of 1 timed cases are noisy' "$work/out/report.html" || complain "the report does not say it"
fi
exit "$failed"
