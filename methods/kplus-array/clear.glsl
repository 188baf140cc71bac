#include "common/kept.glsl"

// Slot 0 is what a fragment must beat: infinity until K are kept.
void clear(uvec2 pixel)
{
    counters[fm_pixel_index(pixel)] = 0u;
    keep_at(pixel, 0u, uvec2(FM_EMPTY_BITS, 0u));
}
