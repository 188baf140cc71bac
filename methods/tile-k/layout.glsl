// Bins: a tile of 8 x 8 pixels, and in it 32 buckets of depth by a triangle's least z. bins holds 33
// words a tile: while counting, each bucket's pairs; then where each bucket's next pair goes, and at
// the end where it ends; the last word is where the tile's pairs begin.
const uint BUCKETS = 32u;
const uint TILE_WORDS = BUCKETS + 1u;
const uint TILES_X = (uint(FM_WIDTH) + 7u) / 8u;

// A pair is the triangle's number and, above 29 bits, which part of a clipped one.
const uint PART_SHIFT = 29u;
const uint TRIANGLE_MASK = (1u << PART_SHIFT) - 1u;

// Triangles whose box has more tiles go to a list: a workgroup for each.
const uint SMALL_TILES = 16u;

// Which bucket a depth falls into: never falls as z rises, which is all that exactness needs. The
// range of depths is a sample's (range.glsl), so it may be any; `precise`, as passes must agree.
float nearest_depth, buckets_per_depth;

void read_range()
{
    bool is_known = range[0] <= 0x3F800000u;
    nearest_depth = is_known ? uintBitsToFloat(range[0]) : 0.0;
    float farthest = is_known ? uintBitsToFloat(~range[1]) : 1.0;
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
