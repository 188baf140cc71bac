// Each block takes the stretch of all its pairs; where it lies does not matter. In it the buckets follow
// each other, nearest first: a lane a bucket. And the dispatch of `fill` is made.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

const uint GROUPS_X = 32768u;

shared uint sums[FM_GROUP_LANES]; // up to and with each bucket
shared uint firsts[BLOCKS];

void add_up(uint bucket)
{
    FM_LOOP for (uint step = 1u; step < BUCKETS; step *= 2u) {
        uint before = bucket >= step ? sums[fm_lane - step] : 0u;
        barrier();
        sums[fm_lane] += before;
        barrier();
    }
}

void make_fill_groups()
{
    uint all = SMALL_GROUPS + groups[LARGE];
    fill_groups[0] = min(all, GROUPS_X);
    fill_groups[1] = (all + GROUPS_X - 1u) / GROUPS_X;
    fill_groups[2] = 1u;
}

void reference(uint tile)
{
    uint block = fm_lane / BUCKETS, bucket = fm_lane % BUCKETS;
    uint bin = (tile * BLOCKS + block) * BIN_WORDS, count = bins[bin + bucket];
    sums[fm_lane] = count;
    barrier();
    add_up(bucket);
    if (bucket == BUCKETS - 1u) { // blocks collide; each gets its own
        uint total = sums[fm_lane];
        firsts[block] = total > 0u ? atomicAdd(groups[ALLOCATED], total) : 0u;
        bins[bin + BUCKETS] = firsts[block];
    }
    barrier();
    bins[bin + bucket] = firsts[block] + sums[fm_lane] - count;
    if (tile == 0u && fm_lane == 0u)
        make_fill_groups();
}
