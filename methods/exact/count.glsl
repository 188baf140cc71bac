void store(uvec2 pixel, float depth, uint colour)
{
    atomicAdd(counters[fm_pixel_index(pixel)], 1u); // a sum: the order of arrival does not matter
}
