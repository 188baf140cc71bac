#!/usr/bin/env bash
# linkage_test.sh PROGRAM [REPORT-PROGRAM]: fragmark links neither VTK nor OpenImageIO, whose loading
# alone costs 0.3 to 0.8 s a start, and a run starts it hundreds of times. fragmark-report may link of
# the runner base, decide, image and model alone: no function of another room is in it, and no driver.
set -euo pipefail
if linked=$(ldd "$1" | grep -E 'libvtk|libOpenImageIO'); then
    printf '%s links what only fragmark-report may:\n%s\n' "$1" "$linked"
    exit 1
fi
# libOSMesa loads LLVM, and is not everywhere: the device opens it.
if linked=$(ldd "$1" | grep -E 'libOSMesa|libLLVM'); then
    printf '%s does not start where there is no libOSMesa:\n%s\n' "$1" "$linked"
    exit 1
fi
[ -n "${2-}" ] || exit 0
# What the program itself asks for: VTK brings libraries of its own.
if linked=$(readelf -d "$2" | grep -E 'NEEDED.*(libvulkan|libOSMesa|libassimp|libqhull)'); then
    printf '%s links what only fragmark may:\n%s\n' "$2" "$linked"
    exit 1
fi
# One function of each room above model.
ours=$(nm "$1") theirs=$(nm "$2")
for name in scene_create scene_mesh truth_open plugin_open device_open vulkan_device tbr_create \
    stage_create instance_create truth_capture worker_main plan_expand run_cases cli_run; do
    grep -q " $name\$" <<<"$ours" || { echo "$1 has no $name: this test asks for the wrong name"; exit 1; }
    if grep -q " $name\$" <<<"$theirs"; then
        echo "$2 holds $name: it links a room above model"
        exit 1
    fi
done
