// Each block takes the stretch of all its pairs; where it lies does not matter. In it the buckets follow
// each other, nearest first. And the dispatch of `fill` is made.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

const uint GROUPS_X = 32768u;

void make_fill_groups()
{
    uint all = SMALL_GROUPS + groups[LARGE];
    fill_groups[0] = min(all, GROUPS_X);
    fill_groups[1] = (all + GROUPS_X - 1u) / GROUPS_X;
    fill_groups[2] = 1u;
}

void take_stretch(uint bin)
{
    uint at = bin * BIN_WORDS, total = 0u, counts[BUCKETS];
    for (uint i = 0u; i < BUCKETS; ++i) { // unrolled: all are on their way at once
        counts[i] = bins[at + i];
        total += counts[i];
    }
    uint next = total > 0u ? atomicAdd(groups[ALLOCATED], total) : 0u; // each gets its own
    bins[at + BUCKETS] = next;
    for (uint i = 0u; i < BUCKETS; ++i) {
        bins[at + i] = next;
        next += counts[i];
    }
}

void reference(uint tile)
{
    if (fm_lane < BLOCKS)
        take_stretch(tile * BLOCKS + fm_lane);
    if (tile == 0u && fm_lane == 0u)
        make_fill_groups();
}
