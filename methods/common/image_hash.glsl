// The runner's own pass after a timed frame: a hash of the picture, so that frames can be compared
// without being read back. It is a sum over pixels, so the order of the atomics does not matter.
uint mixed(uint h) // Murmur3's finaliser
{
    h ^= h >> 16;
    h *= 0x85EBCA6Bu;
    h ^= h >> 13;
    h *= 0xC2B2AE35u;
    return h ^ (h >> 16);
}
uvec2 pixel_hash(uint pixel)
{
    uvec4 words = floatBitsToUint(fm_output[pixel]);
    uvec2 h = uvec2(mixed(pixel + 0x9E3779B9u), mixed(pixel ^ 0x7F4A7C15u));
    for (int i = 0; i < 4; i++)
        h = uvec2(mixed(h.x + words[i]), mixed(h.y ^ words[i]));
    return h;
}

void image_hash(uint tile)
{
    uint side = uint(FM_TILE_PX), across = (uint(FM_WIDTH) + side - 1u) / side;
    uvec2 first = uvec2(tile % across, tile / across) * side;
    uvec2 last = min(first + side, uvec2(FM_WIDTH, FM_HEIGHT)), sum = uvec2(0u);
    FM_LOOP for (uint y = first.y; y < last.y; y++)
        FM_LOOP for (uint x = first.x; x < last.x; x++)
            sum += pixel_hash(fm_pixel_index(uvec2(x, y)));
    atomicAdd(fm_counters[FM_COUNTER_IMAGE_LOW], sum.x);
    atomicAdd(fm_counters[FM_COUNTER_IMAGE_HIGH], sum.y);
}
