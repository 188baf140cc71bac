void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint rank = atomicAdd(counters[i], 1u); // fragments of a pixel collide; each gets its own place
    fragments[offsets[i] + rank] = fm_pack(depth, colour);
}
