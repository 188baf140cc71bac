#include "peer-s-buffer/bins.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide; each gets a place of its own.
    uint local = imageAtomicAdd(fm_image_addresses, ivec2(pixel), 1u);
    fragments[bins[S + bin_of(pixel)] + local] = fm_pack(depth, colour);
}
