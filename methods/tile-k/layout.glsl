// Bins: a tile of 8 x 8 pixels has BLOCKS blocks, each with 32 buckets of depth by a triangle's least
// z. bins holds 33 words a block: while counting, each bucket's pairs; then where each bucket's next
// pair goes, and at the end where it ends; the last word is where the block's pairs begin.
#include "tile-k/lanes.glsl"

const uint BUCKETS = 32u;
const uint BIN_WORDS = BUCKETS + 1u;
const uint TILES_X = (uint(FM_WIDTH) + 7u) / 8u;

// A wide subgroup covers 8 x 4 pixels: small triangles lie in one half of a tile, and the other half
// need not look at them. Elsewhere more pairs cost more than they save. method.c allocates for two.
#if LANES == 32
const uint BLOCKS = 2u;
const ivec2 BLOCK_SHIFT = ivec2(3, 2);
#else
const uint BLOCKS = 1u;
const ivec2 BLOCK_SHIFT = ivec2(3, 3);
#endif
const ivec2 BLOCK_PX = ivec2(1) << BLOCK_SHIFT;

// The bin of the block at `block`, in blocks.
uint bin_of(ivec2 block)
{
    uint row = uint(block.y);
    return (row / BLOCKS * TILES_X + uint(block.x)) * BLOCKS + row % BLOCKS;
}

// groups[]: x y z of the large triangles' dispatch, and more words that begin as 0.
const uint LARGE = 3u; // how many there are
const uint ALLOCATED = 4u; // pairs
const uint LEAST = 5u; // of a sample of depths: the bits, inverted
const uint MOST = 6u;

// Groups that take the small triangles in `fill`; large ones have groups behind them.
const uint SMALL_GROUPS = (uint(FM_TRIANGLES) + uint(FM_GROUP_LANES) - 1u) / uint(FM_GROUP_LANES);

// A pair is the triangle's number and, above 29 bits, which part of a clipped one.
const uint PART_SHIFT = 29u;
const uint TRIANGLE_MASK = (1u << PART_SHIFT) - 1u;

// Triangles whose box has more blocks go to a list: a workgroup for each.
const uint SMALL_BLOCKS = 16u * BLOCKS;

// Which bucket a depth falls into: never falls as z rises, which is all that exactness needs. The
// range of depths is a sample's (range.glsl), so it may be any; `precise`, as passes must agree.
float nearest_depth, buckets_per_depth;

void read_range()
{
    bool is_known = groups[LEAST] != 0u;
    nearest_depth = is_known ? uintBitsToFloat(~groups[LEAST]) : 0.0;
    float farthest = is_known ? uintBitsToFloat(groups[MOST]) : 1.0;
    precise float width = max(farthest - nearest_depth, 1e-30);
    precise float scale = float(USED_BUCKETS) * fm_reciprocal(width);
    buckets_per_depth = scale;
}

uint bucket_of(float z) // after read_range()
{
    precise float at = (z - nearest_depth) * buckets_per_depth;
    return uint(clamp(at, 0.0, float(USED_BUCKETS) - 1.0));
}

// The i-th pixel of a tile in Morton order: 8 make 4 x 2, 32 make 8 x 4.
uvec2 pixel_in_tile(uint i)
{
    return uvec2((i & 1u) | (i >> 1u & 2u) | (i >> 2u & 4u), (i >> 1u & 1u) | (i >> 2u & 2u) | (i >> 3u & 4u));
}
