// Pairs of each bin; large triangles into their list.
#include "tile-k/bin.glsl"

void put(uint bin, uint bucket, uint pair)
{
    atomicAdd(bins[bin * BIN_WORDS + bucket], 1u); // a sum: the order does not matter
}

// The list's dispatch grows with it: x up to 256 groups, then y.
void put_off(uint triangle)
{
    uint at = atomicAdd(groups[LARGE], 1u); // unique; the list's order does not matter
    large[at] = triangle;
    atomicMax(groups[0], min(at + 1u, 256u));
    atomicMax(groups[1], at / 256u + 1u);
    atomicMax(groups[2], 1u);
}

void count(uint triangle)
{
    read_range();
    if (bin_triangle(triangle, false, uvec2(0u, 1u)))
        put_off(triangle);
}
