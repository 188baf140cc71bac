#!/usr/bin/env bash
# frames_test.sh PROGRAM: an exact method is judged by every timed frame, also where depths tie. The
# control `exact` is changed so that it is wrong in one way at a time.
set -euo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failed=0
cp -rL "$(dirname "$program")/methods" "$work/methods"
export FRAGMARK_PLUGIN_PATH=$work/methods
echo '    if (counters[fm_pixel_index(pixel)] == 0u) offsets[fm_pixel_index(pixel)]++;' >"$work/count"
reference=$work/methods/exact/reference.glsl
sed -i '/^void reference/,/^}/ { /^{/r '"$work/count"'
}' "$reference"

# resolve FIRST COUNT: the exact's resolve for layers at one depth; FIRST is emitted in place of the
# second fragment, and COUNT of them: beyond n the first again. TIMED is 1 in timed builds, ODD in every second frame.
resolve() {
    cat >"$work/methods/exact/resolve.glsl" <<GLSL
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[offsets[fm_pixel_index(pixel)] + i];
}
#ifdef FM_CAPTURE
#define TIMED false
#else
#define TIMED true
#endif
void resolve(uvec2 pixel)
{
    bool odd = (offsets[0] & 1u) != 0u; // of an empty pixel: how many frames there were
    uint n = counters[fm_pixel_index(pixel)];
    for (uint i = 0u; i < ($2); i++) {
        uvec2 f = fragment_at(pixel, i == 1u ? ($1) : i < n ? i : 0u);
        fm_emit(pixel, int(i), uintBitsToFloat(f.x), f.y);
    }
}
GLSL
}

# expect STATUS DEPTHS WHAT: `exact` ends so on both devices
expect() {
    for device in vulkan osmesa; do
        rm -rf "$work/out"
        "$program" run -q --no-report --no-images --method exact --scene layers --device $device \
            -a n=4 -a "depths=$2" -a width_px=16 -a height_px=12 -a pixel_density=0.5 -a launches=2 \
            -a frames=4 -a warmup=0 -o "$work/out" 2>"$work/talk" || true
        if ! tail -n +2 "$work/out/summary.csv" | cut -d, -f3 | grep -q "^$1$"; then
            echo "$3 ($device): $(tail -n +2 "$work/out/summary.csv" | cut -d, -f3-5), not $1"
            cat "$work/talk"
            failed=1
        fi
    done
}

resolve 'i' 'n'
expect ok equal 'nothing wrong'
resolve '0u' 'n'
expect wrong_image equal 'a tied fragment in place of another'
resolve 'i' 'n > 0u ? n - 1u : n'
expect wrong_image equal 'a tied fragment dropped'
resolve 'i' 'TIMED && n > 0u ? n - 1u : n'
expect wrong_image equal 'a tied fragment dropped in timed frames'
resolve 'i' 'TIMED && n > 0u ? n + 1u : n'
expect wrong_image equal 'a tied fragment twice in timed frames'
resolve 'i' 'TIMED && odd && n > 0u ? n + 1u : n'
expect wrong_image equal 'a tied fragment twice in every second frame'
resolve 'TIMED && odd ? 0u : 1u' 'n'
expect wrong_image ends 'another picture in every second frame'
exit "$failed"
