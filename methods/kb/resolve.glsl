#include "common/array.glsl"

void resolve(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i) { // already in order
        uvec2 fragment = fragments[array_slot(pixel, i, K)];
        if (fragment.x == FM_EMPTY_BITS)
            break;
        fm_emit(pixel, int(i), uintBitsToFloat(fragment.x), fragment.y);
    }
}
