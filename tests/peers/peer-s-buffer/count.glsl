void store(uvec2 pixel, float depth, uint colour)
{
    imageAtomicAdd(fm_image_counters, ivec2(pixel), 1u); // a sum: the order does not matter
}
