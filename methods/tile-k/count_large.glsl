#include "tile-k/bin.glsl"

void put(uint tile, uint bucket, uint pair)
{
    atomicAdd(bins[tile * TILE_WORDS + bucket], 1u); // a sum: the order does not matter
}
void put_off(uint triangle)
{
}

void count_large(uint i)
{
    if (i / uint(FM_GROUP_LANES) < groups[3])
        bin_large(large[i / uint(FM_GROUP_LANES)], fm_lane);
}
