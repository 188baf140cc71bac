#include "common/array.glsl"

// Slot 0 is what a fragment must beat: infinity until the array is full.
void clear(uvec2 pixel)
{
    counters[fm_pixel_index(pixel)] = 0u;
    fragments[array_slot(pixel, 0u, K)] = uvec2(FM_EMPTY_BITS, 0u);
}
