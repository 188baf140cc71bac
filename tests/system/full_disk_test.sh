#!/usr/bin/env bash
# full_disk_test.sh PROGRAM: a small disk fills while a run writes; it grows, and all rows are ok.
set -euo pipefail
program=$1
work=$(mktemp -d)
disk=$work/disk
trap 'umount "$disk" 2>/dev/null || true; rm -rf "$work"' EXIT
mkdir "$disk"
mount -t tmpfs -o size=20k none "$disk" 2>/dev/null || exit 77
arguments=(run -q --no-report --method exact,kplus-array,wboit --scene layers --device vulkan -a n=8 -a k=4
    -a width_px=48 -a height_px=32 -a launches=2 -a frames=2 -a warmup=0 -o "$disk/out")
failed=0
code=0
stops=0

# Every stop is the run's, and names no method as guilty. The disk grows by little, so that each kind of file is
# once the one that does not fit: the journal, the truth, an answer, an image, a table.
size=20
until [ "$size" -gt 600 ]; do
    mount -o "remount,size=${size}k" "$disk"
    code=0
    "$program" "${arguments[@]}" 2>"$work/talk" || code=$?
    if [ -e "$disk/out/summary.csv" ] &&
        tail -n +2 "$disk/out/summary.csv" | cut -d, -f3 | grep -vq '^ok$\|^skipped$'; then
        echo "a disk of $size kB: a method is blamed: $(tail -n +2 "$disk/out/summary.csv" | cut -d, -f2-5)"
        failed=1
    fi
    [ "$code" -eq 0 ] && break
    stops=$((stops + 1))
    if [ "$code" -ne 5 ] || ! grep -q 'No space left on device' "$work/talk"; then
        echo "a disk of $size kB: exit code $code, not 5: $(cat "$work/talk")"
        failed=1
    fi
    size=$((size + 36))
done
if [ "$code" -ne 0 ] || [ "$(cut -d, -f3 "$disk/out/summary.csv" | grep -c '^ok$')" -ne 3 ]; then
    echo "a disk that is large enough: exit code $code: $(cat "$work/talk" "$disk/out/summary.csv")"
    failed=1
fi
if [ "$stops" -lt 3 ]; then
    echo "the disk was full $stops times only"
    failed=1
fi
exit "$failed"
