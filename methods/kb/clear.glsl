#include "common/array.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < K; ++i)
        fragments[array_slot(pixel, i, K)] = uvec2(FM_EMPTY_BITS, 0u);
}
