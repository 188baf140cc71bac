#define KEPT_PLACES N
#include "common/kept.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide here; the counter gives each a place of its own.
    uint rank = atomicAdd(counters[fm_pixel_index(pixel)], 1u);
    if (rank < N)
        keep_at(pixel, rank, fm_pack(depth, colour));
    else
        fm_lost(pixel);
}
