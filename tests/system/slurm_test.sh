#!/usr/bin/env bash
# slurm_test.sh PROGRAM: a Slurm of one node, started here on loopback, runs an array of 4 shards and
# their merge, which is the unsharded run. A shard that gets TERM ends its journal, goes into the queue
# again and goes on. Skipped where Slurm is not installed: slurmctld slurmd slurm-client munge.
set -euo pipefail
program=$1
export PATH=$PATH:/usr/sbin:/sbin
for name in munged munge slurmctld slurmd sbatch squeue scontrol sinfo; do
    command -v "$name" >/dev/null || { echo "no $name here"; exit 77; }
done
for name in ${!SLURM_*} ${!SBATCH_*}; do
    unset "$name"
done
work=$(mktemp -d /tmp/fragmark-slurm-XXXXXX)
chmod 755 "$work" # munged refuses a socket below a folder that others may not enter
daemons=()
failed=0

stop() {
    scancel --me >/dev/null 2>&1 || true
    for _ in $(seq 100); do
        [ -n "$(timeout 5 squeue -h 2>/dev/null)" ] || break
        sleep 0.1
    done
    for ((i = ${#daemons[@]} - 1; i >= 0; i--)); do
        kill "${daemons[i]}" 2>/dev/null || true
        wait "${daemons[i]}" 2>/dev/null || true
    done
    rm -rf "$work"
}
trap stop EXIT

complain() {
    echo "$*"
    failed=1
}

# within SECONDS COMMAND...: until it succeeds
within() {
    local seconds=$1 until
    shift
    until=$((SECONDS + seconds))
    until "$@"; do
        [ "$SECONDS" -lt "$until" ] || return 1
        sleep 0.2
    done
}

# Slurm: munge for who is who, a controller, a node
mkdir -p "$work"/{munge,ctld,slurmd,log}
chmod 755 "$work/munge"
head -c 128 /dev/urandom >"$work/munge/key"
chmod 400 "$work/munge/key"
port=$((20000 + $$ % 20000))
loopback=
getent hosts "$(hostname)" >/dev/null && loopback=CommunicationParameters=NoCtldInAddrAny,NoInAddrAny
export SLURM_CONF=$work/slurm.conf
cat >"$SLURM_CONF" <<END
ClusterName=test
SlurmctldHost=localhost(127.0.0.1)
SlurmctldPort=$port
SlurmdPort=$((port + 1))
$loopback
SlurmUser=$(id -un)
SlurmdUser=$(id -un)
AuthType=auth/munge
AuthInfo=socket=$work/munge/sock,cred_expire=5
StateSaveLocation=$work/ctld
SlurmdSpoolDir=$work/slurmd
SlurmctldPidFile=$work/slurmctld.pid
SlurmdPidFile=$work/slurmd.pid
ProctrackType=proctrack/pgid
TaskPlugin=task/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_CPU
SlurmdParameters=config_overrides
SchedulerParameters=batch_sched_delay=0,sched_interval=1,sched_min_interval=1,bf_interval=1
KillWait=5
ReturnToService=2
NodeName=localhost NodeHostname=localhost NodeAddr=127.0.0.1 CPUs=8 State=UNKNOWN
PartitionName=main Nodes=ALL Default=YES MaxTime=10 State=UP
END
munged --foreground --socket="$work/munge/sock" --key-file="$work/munge/key" --pid-file="$work/munge/pid" \
    --log-file="$work/munge/log" --seed-file="$work/munge/seed" >"$work/log/munged" 2>&1 &
daemons+=($!)
is_munged() { munge -S "$work/munge/sock" -n >/dev/null 2>&1; }
is_controlled() { scontrol ping >/dev/null 2>&1; }
is_idle() { [ "$(sinfo -h -o %T 2>/dev/null)" = idle ]; }
start_failed() {
    echo "Slurm does not start here: $(tail -3 "$work"/log/*)"
    exit 77
}
within 15 is_munged || start_failed
slurmctld -D -c -f "$SLURM_CONF" >"$work/log/slurmctld" 2>&1 &
daemons+=($!)
within 15 is_controlled || start_failed
slurmd -D -f "$SLURM_CONF" -N localhost >"$work/log/slurmd" 2>&1 &
daemons+=($!)
within 15 is_idle || start_failed

is_empty() { [ -z "$(squeue -h -r 2>/dev/null)" ]; }
state() { # JOB: of each of its tasks, sorted
    scontrol -o show job "$1" | sed -n 's/.*JobState=\([A-Z]*\).*/\1/p' | sort | uniq -c | xargs
}

# same WHOLE MERGED: all cases, in order, with their status
same() {
    diff <(cut -d, -f2,3,5,9,21 "$1/summary.csv") <(cut -d, -f2,3,5,9,21 "$2/summary.csv") >/dev/null ||
        complain "$2 is not the unsharded run"
}

# An array of 4, and the merge
cd "$work"
arguments=(--method exact,kb,ab-array --device dummy -a k=4,8 -a n=2,4,6,8 -a width_px=16 -a height_px=12 -a launches=2
    -a frames=1 -q)
"$program" run "${arguments[@]}" --no-report -o whole >/dev/null 2>&1
"$program" slurm "${arguments[@]}" -n 4 -o "cluster run" --sbatch=--time=5 --submit >ids 2>talk || complain "not submitted: $(cat talk)"
read -r -d '' array merge <ids || true
within 120 is_empty || complain "the jobs do not end: $(squeue)"
[ "$(state "$array")" = "4 COMPLETED" ] || complain "the shards ended otherwise: $(state "$array"); $(tail -3 'cluster run'/logs/*)"
[ "$(state "$merge")" = "1 COMPLETED" ] || complain "the merge ended otherwise: $(state "$merge"); $(cat 'cluster run/logs/merge.log')"
same whole "cluster run/merged"

# The same command again: all is there, and stays
"$program" slurm "${arguments[@]}" -n 4 -o "cluster run" --sbatch=--time=5 --submit >/dev/null 2>&1 || complain "not submitted again"
within 120 is_empty || complain "the second jobs do not end"
grep -q 'goes on' "cluster run/logs/1.log" || grep -q ' ok, ' "cluster run/logs/1.log" || complain "a shard did not go on"
same whole "cluster run/merged"

# TERM while shards run: the journal is whole, and the task goes on by itself
arguments=(--method exact,kb,ab-array --device dummy -a n=2,4 -a width_px=16 -a height_px=12 -a launches=40 -a frames=1)
"$program" slurm "${arguments[@]}" -n 2 -o slow --sbatch=--time=5 --requeues 2 --submit >ids 2>talk || complain "not submitted: $(cat talk)"
read -r -d '' array merge <ids || true
has_begun() { [ "$(cat slow/shard-1/journal.jsonl 2>/dev/null | grep -c '"event":"end"')" -ge 5 ]; }
within 30 has_begun || complain "the shard does not begin"
scancel --batch --signal=TERM "${array}_1"
was_stopped() { grep -q 'interrupted, nothing is lost' slow/logs/1.log; }
within 30 was_stopped || complain "TERM did not reach the shard: $(tail -3 slow/logs/1.log)"
within 120 is_empty || complain "the jobs do not end: $(squeue)"
[ "$(state "$array")" = "2 COMPLETED" ] || complain "after TERM: $(state "$array"); $(tail -3 slow/logs/*)"
[ "$(state "$merge")" = "1 COMPLETED" ] || complain "the merge after TERM: $(state "$merge"); $(cat slow/logs/merge.log)"
grep -q 'goes on with what an earlier run left' slow/logs/1.log || complain "the shard began anew"
begun=$(grep -c '"event":"begin"' slow/shard-1/journal.jsonl)
ended=$(grep -c '"event":"end"' slow/shard-1/journal.jsonl)
[ "$begun" -le $((ended + 1)) ] || complain "launches were measured twice: $begun begun, $ended ended"
grep -q '"missing": \[\]' slow/merged/manifest.json || complain "the merge lacks something"

# Without --requeues TERM ends the task, and the same command goes on
one=("$program" slurm "${arguments[@]}" -n 1 -o one --sbatch=--time=5 --submit)
"${one[@]}" >ids 2>talk || complain "not submitted: $(cat talk)"
read -r -d '' array merge <ids || true
has_begun() { [ "$(cat one/shard-1/journal.jsonl 2>/dev/null | grep -c '"event":"end"')" -ge 5 ]; }
within 30 has_begun || complain "the shard does not begin"
scancel --batch --signal=TERM "${array}_1"
within 60 is_empty || complain "the jobs do not end: $(squeue)"
[ "$(state "$array")" = "1 FAILED" ] || complain "TERM did not end the task: $(state "$array")"
grep -q 'is not finished' one/logs/merge.log || complain "the merge does not name the shard"
"${one[@]}" >ids 2>talk || complain "not submitted: $(cat talk)"
read -r -d '' array merge <ids || true
within 120 is_empty || complain "the jobs do not end: $(squeue)"
[ "$(state "$array") $(state "$merge")" = "1 COMPLETED 1 COMPLETED" ] || complain "it did not go on: $(state "$array")"
exit "$failed"
