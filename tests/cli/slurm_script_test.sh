#!/usr/bin/env bash
# slurm_script_test.sh PROGRAM: the scripts that `fragmark slurm` writes, without Slurm: bash runs them as
# tasks, and a sbatch of our own takes them. system/slurm_test.sh has the real one.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work"
failed=0

complain() {
    echo "$*"
    failed=1
}

# expect CODE TEXT ARGUMENT...
expect() {
    local wanted=$1 text=$2 code=0
    shift 2
    "$program" slurm "$@" >talk 2>&1 || code=$?
    [ "$code" = "$wanted" ] || complain "fragmark slurm $*: exit code $code, not $wanted: $(cat talk)"
    grep -q -- "$text" talk || complain "fragmark slurm $*: does not say '$text': $(cat talk)"
}

printf 'methods: [kb, exact]\ndevices: [dummy]\nn: [2, 4]\nk: 2\nwidth_px: 16\nheight_px: 12\nlaunches: 1\n' >"my spec.yml"
expect 0 'sbatch --dependency=afterany:$job' "my spec.yml" -a frames=1 -q -n 3 -o "my jobs" \
    --sbatch=--partition=short --shard-sbatch --gres=gpu:1 --signal-lead 90
for line in '--array=1-3' '--signal=B:TERM@90' '--requeue' '--partition=short' '--gres=gpu:1' '--open-mode=append'; do
    grep -q "^#SBATCH $line\$" "my jobs/shards.sbatch" || complain "shards.sbatch lacks $line"
done
grep -q '^#SBATCH --partition=short$' "my jobs/merge.sbatch" || complain "merge.sbatch lacks the partition"
grep -q 'gres' "my jobs/merge.sbatch" && complain "merge.sbatch wants a GPU"

# As tasks, from another folder, and for some reason not all of them
for task in 1 3; do
    (cd / && SLURM_ARRAY_TASK_ID=$task bash "$work/my jobs/shards.sbatch") >log 2>&1 || complain "task $task: $(cat log)"
done
code=0
bash "my jobs/merge.sbatch" >log 2>&1 || code=$?
[ "$code" = 5 ] || complain "the merge of two shards: exit code $code, not 5: $(cat log)"
grep -q 'shard 2/3 is missing' log || complain "the merge does not name the shard: $(cat log)"
SLURM_ARRAY_TASK_ID=2 bash "my jobs/shards.sbatch" >log 2>&1 || complain "task 2: $(cat log)"
code=0
bash "my jobs/merge.sbatch" >log 2>&1 || code=$?
[ "$(($(wc -l <"my jobs/merged/summary.csv") - 1))" = 4 ] || complain "the merge has not 4 rows: $(cat log)"

# The same command again is the same jobs; other ones are refused
expect 0 'afterany' "my spec.yml" -a frames=1 -q -n 3 -o "my jobs" --sbatch=--partition=long
grep -q 'partition=long' "my jobs/shards.sbatch" || complain "options of sbatch did not change"
expect 2 'of another command' "my spec.yml" -a frames=1 -q -n 4 -o "my jobs"
expect 2 'of another command' "my spec.yml" -a frames=2 -q -n 3 -o "my jobs"
mkdir other && touch other/file
expect 2 'holds something else' "my spec.yml" -n 2 -o other
mkdir empty
expect 0 'afterany' "my spec.yml" -n 2 -o empty

# A task that is stopped goes into the queue again, as often as is allowed
mkdir bin
printf '#!/bin/sh\necho "$@" >>"%s/requeued"\n' "$work" >bin/scontrol
printf '#!/bin/sh\necho "$@" >>"%s/submitted"\necho "4%s;here"\n' "$work" '$(wc -l <"'"$work"'/submitted")' >bin/sbatch
chmod +x bin/*
export PATH=$work/bin:$PATH
"$program" slurm --method kb --device dummy -a launches=1000 -a frames=1 -a width_px=16 -a height_px=12 -n 1 -o long --requeues 2 >/dev/null
stopped() { # RESTARTS: the task's exit code
    rm -rf long/shard-1
    SLURM_ARRAY_JOB_ID=7 SLURM_ARRAY_TASK_ID=1 SLURM_RESTART_COUNT=$1 bash long/shards.sbatch >log 2>&1 &
    local task=$! code=0
    for _ in $(seq 6000); do
        [ "$(cat long/shard-1/journal.jsonl 2>/dev/null | grep -c '"event":"end"')" -lt 2 ] || break
        sleep 0.02
    done
    kill -TERM "$task"
    wait "$task" || code=$?
    [ "$code" = 143 ] || complain "TERM: exit code $code, not 143: $(tail -3 log)"
    grep -q 'interrupted, nothing is lost' log || complain "TERM did not reach the run: $(tail -3 log)"
}
stopped 1
[ "$(cat requeued 2>/dev/null)" = "requeue 7_1" ] || complain "it was not put into the queue again"
stopped 2
[ "$(cat requeued)" = "requeue 7_1" ] || complain "it was put into the queue too often"

expect 0 'shard 1 of 9, of 4 cases in 2 groups that stay together' "my spec.yml" -n 9 -o many

# Submitted: the merge after the array
expect 0 '^41$' "my spec.yml" -n 2 -o sent --submit
grep -q '^--parsable --dependency=afterany:41 .*/merge.sbatch$' submitted || complain "the merge does not wait: $(cat submitted)"
printf '#!/bin/sh\necho "sbatch: error: Invalid partition" >&2\nexit 1\n' >bin/sbatch
expect 5 'Invalid partition' "my spec.yml" -n 2 -o sent --submit
rm bin/sbatch
command -v sbatch >/dev/null || expect 3 'slurm-client' "my spec.yml" -n 2 -o sent --submit

# Figures, with our options before or behind
expect 0 'afterany' -n 2 --requeues 1 reproduce kplus-05 --smoke -o figure
expect 0 'afterany' -n 2 --requeues 0 reproduce kplus-05 --smoke -o never
grep -q 'fragmark reproduce kplus-05 --smoke --shard' figure/shards.sbatch || complain "no reproduction: $(cat figure/shards.sbatch)"
expect 0 'afterany' run "my spec.yml" -n 2 -o spec
grep -q "fragmark run 'my spec.yml' --shard" spec/shards.sbatch || complain "no run: $(cat spec/shards.sbatch)"

# Bad arguments are told now, not by the tasks
expect 2 'how many shards' "my spec.yml"
expect 2 '1..1000' "my spec.yml" -n 0
expect 2 '1..1000' "my spec.yml" -n 1001
expect 2 'begins with' "my spec.yml" -n 2 --sbatch partition
expect 2 'each task has its own' "my spec.yml" -n 2 --shard 1/2
expect 2 "unrecognized option" "my spec.yml" -n 2 --methode kb
expect 2 "nearest is 'kb'" --method kbb -n 2
expect 2 'No such file' nowhere.yml -n 2
expect 2 'Slurm takes no' "my spec.yml" -n 2 -o 50%
expect 0 'reproduce kplus' --help
exit "$failed"
