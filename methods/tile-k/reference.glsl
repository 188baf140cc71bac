// Each block takes the stretch of all its pairs; where it lies does not matter. In it the buckets follow
// each other, nearest first. And the dispatches of `fill` and `store` are made.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

uvec3 groups_of(uint count)
{
    return uvec3(min(count, GROUPS_X), (count + GROUPS_X - 1u) / GROUPS_X, 1u);
}

void make_dispatches(uint tiles)
{
    uvec3 of_fill = groups_of(SMALL_GROUPS + min(groups[LARGE], LARGE_MAX)), of_store = groups_of(tiles);
    for (int i = 0; i < 3; ++i) {
        fill_groups[i] = of_fill[i];
        if (!LISTS_TILES)
            store_groups[i] = of_store[i];
    }
}

// The dispatch grows with the list, whose order does not matter.
void list_tile(uint tile)
{
    uint at = atomicAdd(store_groups[LISTED], 1u);
    uvec3 dispatch = groups_of(at + 1u);
    listed[at] = tile;
    for (int i = 0; i < 3; ++i)
        atomicMax(store_groups[i], dispatch[i]);
}

#if LANES == 32

// A workgroup a tile, a lane a bucket of one of its two blocks.
shared uint sums[FM_GROUP_LANES];
shared uint first_of_tile;

void reference(uint tile)
{
    uint at = (tile * BLOCKS + fm_lane / BUCKETS) * BIN_WORDS, bucket = fm_lane % BUCKETS;
    uint count = bins[at + bucket];
    sums[fm_lane] = count;
    for (uint step = 1u; step < uint(FM_GROUP_LANES); step *= 2u) { // of this lane and all before it
        barrier();
        uint before = fm_lane >= step ? sums[fm_lane - step] : 0u;
        barrier();
        sums[fm_lane] += before;
    }
    if (fm_lane == uint(FM_GROUP_LANES) - 1u) // each gets its own
        first_of_tile = sums[fm_lane] > 0u ? atomicAdd(groups[ALLOCATED], sums[fm_lane]) : 0u;
    barrier();
    uint next = first_of_tile + sums[fm_lane] - count;
    bins[at + bucket] = next;
    if (bucket == 0u)
        bins[at + BUCKETS] = next;
    if (tile == 0u && fm_lane == 0u)
        make_dispatches(TILES);
}

#else

// How many pairs it has.
uint take_stretch(uint bin)
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
    return total;
}

void reference(uint tile)
{
    if (fm_lane == 0u && take_stretch(tile) > 0u && LISTS_TILES)
        list_tile(tile);
    if (tile == 0u && fm_lane == 0u)
        make_dispatches(TILES);
}

#endif
