#include "tile-k/bin.glsl"

void put(uint tile, uint bucket, uint pair)
{
    pairs[atomicAdd(bins[tile * TILE_WORDS + bucket], 1u)] = pair; // collide; each gets its own place
}
void put_off(uint triangle)
{
}

void fill_large(uint i)
{
    if (i / uint(FM_GROUP_LANES) < groups[3])
        bin_large(large[i / uint(FM_GROUP_LANES)], fm_lane);
}
