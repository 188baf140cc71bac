#include "kb-packed/pairs.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < PAIRS; ++i)
        put_pair(pixel, i, uvec4(FM_EMPTY_BITS, 0u, FM_EMPTY_BITS, 0u));
}
