// Each tile takes the stretch of all its pairs; where it lies does not matter. In it the buckets follow
// each other, nearest first.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

void reference(uint tile)
{
    uint at = tile * TILE_WORDS, total = 0u;
    FM_LOOP for (uint i = 0u; i < BUCKETS; ++i)
        total += bins[at + i];
    uint next = total > 0u ? atomicAdd(allocated[0], total) : 0u; // tiles collide; each gets its own
    bins[at + BUCKETS] = next;
    FM_LOOP for (uint i = 0u; i < BUCKETS; ++i) {
        uint count = bins[at + i];
        bins[at + i] = next;
        next += count;
    }
}
