#!/usr/bin/env bash
# limits_test.sh PROGRAM: a missing driver, limits, signals and readers that go are nobody's fault: the run stops with
# exit code 5 or goes on, and the same command ends well. Wrong folders and words are told before anything is run.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
chmod 755 "$work"
arguments=(run --no-report --no-images --method exact --scene layers --device vulkan -a n=2 -a width_px=16
    -a height_px=16 -a launches=1 -a frames=1 -a warmup=0)
failed=0

# expect CODE WORDS WHAT COMMAND...: the command exits with the code and says the words
expect() {
    local wanted=$1 words=$2 what=$3 code=0
    shift 3
    "$@" >"$work/talk" 2>&1 || code=$?
    if [ "$code" -ne "$wanted" ] || ! grep -q -- "$words" "$work/talk"; then
        echo "$what: exit code $code, not $wanted, or without '$words': $(cat "$work/talk")"
        failed=1
    fi
}

# finish NAME: what was stopped ends well with the same command
finish() {
    expect 0 "1 ok" "$1, continued" "$program" "${arguments[@]}" -o "$work/$1"
}

expect 5 "no driver can be loaded from what VK_DRIVER_FILES names" "no driver" env VK_ICD_FILENAMES=/nowhere.json VK_DRIVER_FILES=/nowhere.json \
    "$program" "${arguments[@]}" -o "$work/driver"
finish driver
# The shell writes in blocks of 1024 bytes.
expect 5 "File too large" "files of 2 kB" bash -c 'ulimit -f 2; exec "$@"' - "$program" "${arguments[@]}" -o "$work/size"
finish size
for memory in 300000 600000; do # a truth that was kept needs less
    expect 5 'ulimit -v\|out of device memory' "$memory kB of memory" bash -c "ulimit -v $memory; exec \"\$@\"" - \
        "$program" "${arguments[@]}" --no-cache -o "$work/memory"
done
finish memory
for files in 6 9 11; do
    expect 5 "Too many open files" "$files files" bash -c "ulimit -n $files; exec \"\$@\"" - \
        "$program" "${arguments[@]}" -o "$work/files"
done
finish files

expect 2 "is no folder" "a file as folder" "$program" "${arguments[@]}" -o "$work/talk"
if command -v setpriv >/dev/null && [ "$(id -u)" -eq 0 ]; then
    mkdir -m 755 "$work/locked"
    as=(setpriv --reuid=65534 --regid=65534 --clear-groups)
    if "${as[@]}" "$program" --version >/dev/null 2>&1; then
        expect 2 "locked/a: cannot be made: Permission denied" "a locked folder" \
            "${as[@]}" "$program" "${arguments[@]}" -o "$work/locked/a/b"
        "$program" "${arguments[@]}" -o "$work/locked/ours" >/dev/null 2>&1
        expect 2 "Permission denied" "somebody else's results" \
            "${as[@]}" "$program" "${arguments[@]}" -o "$work/locked/ours"
    fi
fi

expect 2 "the nearest is 'crash'" "a typo" "$program" "${arguments[@]}" --retry crahs -o "$work/driver"
expect 2 "what is well stays" "--retry ok" "$program" "${arguments[@]}" --retry timeout,ok -o "$work/driver"
expect 0 "goes on with what an earlier run left" "a run that goes on" "$program" "${arguments[@]}" \
    --retry crash,timeout -o "$work/driver"
expect 2 "another plan" "another plan" "$program" "${arguments[@]}" --seed 5 -o "$work/driver"
if grep -q 'goes on with' "$work/talk"; then
    echo "a refused run says that it goes on"
    failed=1
fi

# Who reads the talk goes away.
set +e
"$program" "${arguments[@]}" -o "$work/head" 2>&1 | head -0
code=${PIPESTATUS[0]}
set -e
[ "$code" -eq 0 ] || { echo "| head: exit code $code"; failed=1; }

# hang_up WANTED NAME COMMAND...: starts a long run so, and hangs up while it is at work
hang_up() {
    local wanted=$1 name=$2 code=0
    shift 2
    "$@" "$program" "${arguments[@]/launches=1/launches=5}" -o "$work/$name" >"$work/talk" 2>&1 &
    local parent=$!
    while [ ! -e "$work/$name/manifest.json" ] && kill -0 "$parent" 2>/dev/null; do sleep 0.05; done
    sleep 0.2
    kill -HUP "$parent" 2>/dev/null || true
    wait "$parent" || code=$?
    if [ "$code" -ne "$wanted" ]; then
        echo "$name: exit code $code, not $wanted: $(cat "$work/talk")"
        failed=1
    fi
}
hang_up 129 hang-up env
hang_up 0 nohup nohup
exit "$failed"
