#include "common/kept.glsl"
#include "kplus-array/counter.glsl"

// Slot 0 is what a fragment must beat: infinity until K are kept.
void clear(uvec2 pixel)
{
    count_none(pixel);
    keep_at(pixel, 0u, uvec2(FM_EMPTY_BITS, 0u));
}
