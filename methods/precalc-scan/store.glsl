void store(uvec2 pixel, float depth, uint colour)
{
    // Fragments of a pixel collide; each gets a place of its own.
    uint at = atomicAdd(addresses[fm_pixel_index(pixel)], 1u);
    fragments[at] = fm_pack(depth, colour);
}
