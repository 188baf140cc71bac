// Pairs into their bins: an invocation for each small triangle, then a workgroup for each large one.
// Within a bin any order is right.
#include "tile-k/bin.glsl"

void put(uint bin, uint bucket, uint pair)
{
    pairs[atomicAdd(bins[bin * BIN_WORDS + bucket], 1u)] = pair; // collide; each gets its own place
}

void fill(uint i)
{
    uint group = i / uint(FM_GROUP_LANES), at = group - SMALL_GROUPS;
    bool is_large = group >= SMALL_GROUPS;
    uint triangle = !is_large ? i : at < groups[LARGE] ? large[at] : uint(FM_TRIANGLES);
    read_range();
    if (triangle < uint(FM_TRIANGLES))
        bin_triangle(triangle, is_large, is_large ? uvec2(fm_lane, FM_GROUP_LANES) : uvec2(0u, 1u));
}
