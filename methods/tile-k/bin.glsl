// A triangle's blocks, each by an exact test of its edges. Loops test at their end: software runs the body
// of one that tests first once more, for nobody. Who includes this defines
//   void put(uint bin, uint bucket, uint pair)   what happens to a pair
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

void put(uint bin, uint bucket, uint pair);

// How many large_at() has. A macro: not every pass has the buffer.
#define large_count() min(bins[HEAD_LARGE], LARGE_MAX)

// Whether no pixel of its box is covered, where that is at most 2 x 2: so it is with a quarter of the triangles
// that are about as large as a pixel. `edges`: at `corner`.
bool misses_all(fm_setup t, ivec3 edges, ivec2 corner)
{
    ivec2 first = t.box.xy - corner, more = t.box.zw - t.box.xy;
    ivec3 a = more.x > 0 ? t.a : ivec3(0), b = more.y > 0 ? t.b : ivec3(0);
    ivec3 e = edges + t.a * first.x + t.b * first.y;
    ivec3 f = e + a, g = e + b, h = f + b;
    int misses = (e.x | e.y | e.z) & (f.x | f.y | f.z) & (g.x | g.y | g.z) & (h.x | h.y | h.z);
    return all(lessThan(more, ivec2(2))) && misses < 0;
}

// Its blocks from `first` on, `size` columns and rows within REACH_PX: so far an edge is held by 32 bits, and the
// wide sum is needed but once. Which of 2 x 2 are covered, if there are no more.
uint bin_blocks(fm_setup t, uint pair, uint bucket, ivec2 first, ivec2 size)
{
    ivec3 reach = max(t.a, ivec3(0)) * (BLOCK_PX.x - 1) + max(t.b, ivec3(0)) * (BLOCK_PX.y - 1);
    ivec3 edges = fm_edges_at(t, first << BLOCK_SHIFT);
    ivec3 row = edges + reach, most = row; // of each edge in the block
    ivec2 at = ivec2(0);
    uint covered = 0u;
    int i = misses_all(t, edges, first << BLOCK_SHIFT) ? 0 : size.x * size.y;
    FM_LOOP do {
        if ((most.x | most.y | most.z) >= 0 && i > 0) {
            put(bin_of(first + at), bucket, pair);
            covered |= 1u << (at.x + 2 * at.y & 31);
        }
        bool is_next_row = ++at.x == size.x;
        row = is_next_row ? row + t.b * BLOCK_PX.y : row;
        most = is_next_row ? row : most + t.a * BLOCK_PX.x;
        at = is_next_row ? ivec2(0, at.y + 1) : at;
    } while (--i > 0);
    return covered;
}

// Its box in stretches of `each` blocks, of which this invocation takes first, first + stride, ...
// Returns bin_blocks() of a box that is one stretch.
uint bin_part(fm_setup t, uint pair, ivec2 size, ivec2 each, ivec2 first_and_stride)
{
    ivec2 corner = t.box.xy >> BLOCK_SHIFT, stretches = (size + each - 1) / each;
    uint bucket = bucket_of(fm_nearest(t.z_least, t.z_most)), covered = 0u;
    int i = first_and_stride.x, count = stretches.x * stretches.y;
    FM_LOOP do {
        ivec2 at = ivec2(i % stretches.x, i / stretches.x) * each;
        if (i < count)
            covered = bin_blocks(t, pair, bucket, corner + at, min(size - at, each));
        i += first_and_stride.y;
    } while (i < count);
    return covered;
}

// Columns and rows of its box.
ivec2 size_of(fm_setup t)
{
    return (t.box.zw >> BLOCK_SHIFT) - (t.box.xy >> BLOCK_SHIFT) + 1;
}

bool is_small(ivec2 size)
{
    return size.x * size.y <= SMALL_BLOCKS && size.x * BLOCK_PX.x + size.y * BLOCK_PX.y <= REACH_PX;
}

// The parts that are large, by a workgroup, or those that are not, by this invocation; whether there
// were others.
bool bin_triangle(uint triangle, bool wants_large)
{
    fm_setup t;
    bool has_others = false;
    uint parts = fm_parts(triangle), part = 0u;
    FM_LOOP do {
        bool has_pixels = fm_set_up(t, part) && part < parts;
        ivec2 size = size_of(t);
        bool is_wanted = is_small(size) != wants_large;
        if (has_pixels && is_wanted)
            bin_part(t, triangle | part << PART_SHIFT, size, wants_large ? LARGE_STRETCH : size,
                     wants_large ? ivec2(fm_lane, FM_GROUP_LANES) : ivec2(0, 1));
        has_others = has_others || (has_pixels && !is_wanted);
    } while (++part < parts);
    return has_others;
}
