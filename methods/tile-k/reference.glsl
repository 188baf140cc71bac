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
    uvec3 of_fill = groups_of(SMALL_GROUPS + min(bins[HEAD_LARGE], LARGE_MAX)), of_store = groups_of(tiles);
    for (int i = 0; i < 3; ++i) {
        fill_groups[i] = of_fill[i];
        if (!LISTS_TILES)
            store_groups[i] = of_store[i];
    }
}

// The dispatch grows with the list, whose order does not matter.
void list_tile(uint tile)
{
    uint at = atomicAdd(store_groups[STORE_GROUPS_LISTED], 1u);
    uvec3 dispatch = groups_of(at + 1u);
    listed_tile_at(at) = tile;
    for (int i = 0; i < 3; ++i)
        atomicMax(store_groups[i], dispatch[i]);
}

#if LANES == 32

// A workgroup a tile, a lane a bucket of a block. Of an empty tile all words are 0, as cleared.
shared uint filled[FM_GROUP_LANES / LANES]; // buckets of a block, one bit each
shared uint sums[FM_GROUP_LANES];
shared uint first_of_tile;
const uint LANES_USED = TILE_BLOCKS * BUCKETS;

void reference(uint tile)
{
    uint block = fm_lane / BUCKETS, bucket = fm_lane % BUCKETS, at = words_of(tile * TILE_BLOCKS + block);
    bool is_used = fm_lane < LANES_USED;
    uint count = is_used ? bins[at + bucket] : 0u;
    if (tile == 0u && fm_lane == 0u)
        make_dispatches(TILES);
    filled[this_place() / uint(LANES)] = votes(count > 0u);
    sums[fm_lane] = count;
    barrier();
    if ((filled[0] | filled[1]) == 0u)
        return;
    for (uint step = 1u; step < LANES_USED; step *= 2u) { // of this lane and all before it
        barrier();
        uint before = fm_lane >= step ? sums[fm_lane - step] : 0u;
        barrier();
        sums[fm_lane] += before;
    }
    if (fm_lane == LANES_USED - 1u) // each gets its own
        first_of_tile = atomicAdd(bins[HEAD_PAIRS], sums[fm_lane]);
    barrier();
    uint next = first_of_tile + sums[fm_lane] - count;
    if (is_used)
        bins[at + bucket] = next;
    if (is_used && bucket == 0u)
        bins[at + BUCKETS] = next;
}

#else

// How many pairs it has.
uint take_stretch(uint bin)
{
    uint at = words_of(bin), total = 0u, counts[BUCKETS];
    for (uint i = 0u; i < BUCKETS; ++i) { // unrolled: all are on their way at once
        counts[i] = bins[at + i];
        total += counts[i];
    }
    uint next = total > 0u ? atomicAdd(bins[HEAD_PAIRS], total) : 0u; // each gets its own
    bins[at + BUCKETS] = next;
    for (uint i = 0u; i < BUCKETS; ++i) {
        bins[at + i] = next;
        next += counts[i];
    }
    return total;
}

void reference(uint tile)
{
    uint total = 0u;
    for (uint i = 0u; i < TILE_BLOCKS && fm_lane == 0u; ++i)
        total += take_stretch(tile * TILE_BLOCKS + i);
    if (total > 0u && LISTS_TILES)
        list_tile(tile);
    if (tile == 0u && fm_lane == 0u)
        make_dispatches(TILES);
}

#endif
