#include "s-buffer/place.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide; each gets a place of its own.
    uint local = atomicAdd(addresses[fm_pixel_index(pixel)], 1u);
    fragments[bin_place(pixel, local)] = fm_pack(depth, colour);
}
