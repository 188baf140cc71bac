#include "kb/slots.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i)
        keep_at(pixel, i, uvec2(FM_EMPTY_BITS, 0u));
}
