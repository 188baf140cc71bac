// A pair adds to its bin.
#include "tile-k/bin.glsl"

void put(uint bin, uint bucket, uint pair)
{
    atomicAdd(bins[words_of(bin) + bucket], 1u); // a sum: the order does not matter
}
