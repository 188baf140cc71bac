#include "s-buffer/per_pixel.glsl"
#include "s-buffer/place.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide; each gets a place of its own.
    uint local = add_to_address(pixel);
    fragments[bin_place(pixel, local)] = fm_pack(depth, colour);
}
