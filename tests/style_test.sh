#!/usr/bin/env bash
# style_test.sh: all C and C++ files are formatted, no source file has over 500 lines, no function
# over 80. Parts whose tool is not installed are left out, and say so.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
failed=0

mapfile -t sources <<<"$(find methods generators runner reports tests \
    -name '*.[ch]' -o -name '*.cpp' | sort)"
mapfile -t shaders <<<"$(find methods tests -name '*.glsl' | sort)"

if command -v clang-format >/dev/null; then
    for file in "${sources[@]}"; do
        if ! clang-format --dry-run -Werror "$file" >/dev/null 2>&1; then
            echo "$file: not formatted; run: clang-format -i $file"
            failed=1
        fi
    done
else
    echo "clang-format is not installed: formatting was not checked"
fi

for file in "${sources[@]}" "${shaders[@]}"; do
    lines=$(wc -l <"$file")
    if [ "$lines" -gt 500 ]; then
        echo "$file: $lines lines; split it by concept (500 at most)"
        failed=1
    fi
done

if ctags --version 2>/dev/null | grep -q 'Universal Ctags'; then
    long=$(ctags -f - --languages=C,C++ --kinds-C=f --kinds-C++=f --fields=+ne -n \
        --langmap=C:.c,C++:.cpp "${sources[@]}" |
        awk -F'\t' '/^!/ { next } {
            first = last = 0
            for (i = 3; i <= NF; i++) {
                if ($i ~ /^line:/) first = substr($i, 6)
                if ($i ~ /^end:/) last = substr($i, 5)
            }
            if (last - first + 1 > 80)
                printf "%s:%d: %s has %d lines (80 at most)\n", $2, first, $1, last - first + 1
        }')
    if [ -n "$long" ]; then
        echo "$long"
        failed=1
    fi
else
    echo "universal-ctags is not installed: function length was not checked"
fi
exit "$failed"
