// A workgroup for each large triangle.
#include "tile-k/bin.glsl"

void put(uint bin, uint bucket, uint pair)
{
    atomicAdd(bins[bin * BIN_WORDS + bucket], 1u); // a sum: the order does not matter
}

void count_large(uint i)
{
    uint at = i / uint(FM_GROUP_LANES);
    if (at < large_count())
        bin_triangle(large_at(at), true);
}
