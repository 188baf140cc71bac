// Pairs into their bins. Within a bin any order is right.
#include "tile-k/bin.glsl"

void put(uint tile, uint bucket, uint pair)
{
    pairs[atomicAdd(bins[tile * TILE_WORDS + bucket], 1u)] = pair; // collide; each gets its own place
}
void put_off(uint triangle) // is in the list since the count
{
}

void fill(uint triangle)
{
    bin_small(triangle);
}
