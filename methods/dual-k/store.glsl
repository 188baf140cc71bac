#include "dual/peel.glsl"

// While the ends of all are found, fragments are counted: where a pixel's k nearest end, seen from behind.
void store(uvec2 pixel, float depth, uint colour)
{
    if (fm_iteration == 0u)
        atomicAdd(counts[fm_pixel_index(pixel)], 1u); // a sum: the order of arrival does not matter
    peel(pixel, depth, colour);
}
