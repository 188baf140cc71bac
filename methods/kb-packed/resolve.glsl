#include "kb-packed/pairs.glsl"

void resolve(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) { // already in order
        uvec4 pair = pair_at(pixel, i / 2u);
        uvec2 fragment = i % 2u == 0u ? pair.xy : pair.zw;
        if (fragment.x == FM_EMPTY_BITS)
            break;
        fm_emit(pixel, int(i), uintBitsToFloat(fragment.x), fragment.y);
    }
}
