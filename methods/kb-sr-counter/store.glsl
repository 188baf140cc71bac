#include "common/kept.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide here; the counter gives each a number of its own, its sample. As
    // with the stencil, arrivals after the k-th find none: that is the method, not a loss of storage.
    uint arrival = atomicAdd(arrivals[fm_pixel_index(pixel)], 1u);
    if (arrival < K)
        keep_at(pixel, arrival, fm_pack(depth, colour));
}
