#!/usr/bin/env bash
# reason_test.sh: what may make a case not_supported says why in a word. In the rooms that plan and measure, FM_UNSUPPORTED
# is made by fm_refuse and fm_error_refuse (runner/base/error.c) only, or stands in a table beside its reason.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

mapfile -t rooms <<<"$(sed -n '/^set(FM_RUNNER_ROOMS/,/)/p' rooms.cmake | tr -s ' \n()' '\n' |
    sed -n '/^base$/,/^plan$/p')"
files=()
for room in "${rooms[@]}"; do
    for folder in "runner/$room" "$room"; do # those of devices lie within runner/device
        [ -d "$folder" ] && mapfile -t -O "${#files[@]}" files <<<"$(find "$folder" -name '*.c' | sort -u)"
    done
done
[ "${#files[@]}" -gt 150 ] || { echo "only ${#files[@]} files of ${#rooms[@]} rooms are looked at"; exit 1; }

# Comparisons make none, nor do comments, which stand alone or begin in front of the word.
if grep -nH 'FM_UNSUPPORTED' "${files[@]}" | grep -v '^runner/base/error\.c:' |
    grep -vE '(==|!=|case) *FM_UNSUPPORTED|FM_REASON_|/\*.*FM_UNSUPPORTED|^[^:]*:[0-9]+: \*'; then
    echo "these refuse without a reason: use fm_refuse (runner/base/error.h)"
    exit 1
fi
