#!/usr/bin/env bash
# linkage_test.sh PROGRAM: fragmark links neither VTK nor OpenImageIO, whose loading alone costs
# 0.3 to 0.8 s a start, and a run starts it hundreds of times.
set -euo pipefail
if linked=$(ldd "$1" | grep -E 'libvtk|libOpenImageIO'); then
    printf '%s links what only fragmark-report may:\n%s\n' "$1" "$linked"
    exit 1
fi
