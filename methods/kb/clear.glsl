#include "common/array.glsl"
#include "kb/slots.glsl"

void clear(uvec2 pixel)
{
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i)
        fragments[array_slot(pixel, i, SLOTS)] = uvec2(FM_EMPTY_BITS, 0u);
}
