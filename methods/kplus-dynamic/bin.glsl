#include "kplus-dynamic/histogram.glsl"

// Pixels of one depth collide, as published; sums do not depend on the order.
void bin(uvec2 pixel)
{
    uint count = counters[fm_pixel_index(pixel)];
    if (count == 0u)
        return;
    atomicAdd(histogram[min(count, DEEPEST)], 1u);
    if (count > DEEPEST)
        atomicAdd(histogram[0], count - DEEPEST);
}
