// Pairs of each bin; large triangles into their list.
#include "tile-k/count_pair.glsl"

// Whether there was room. The list's dispatch grows with it: x up to 256 groups, then y.
bool put_off(uint triangle)
{
    uint at = atomicAdd(bins[HEAD_LARGE], 1u); // unique; the list's order does not matter
    if (at >= LARGE_MAX)
        return false;
    large_at(at) = triangle;
    atomicMax(bins[0], min(at + 1u, 256u));
    atomicMax(bins[1], at / 256u + 1u);
    atomicMax(bins[2], 1u);
    return true;
}

#if TAKES_NOTES

uint note_of(fm_setup t, ivec2 size, uint covered)
{
    uvec2 block = uvec2(t.box.xy >> BLOCK_SHIFT);
    bool is_tiny = all(lessThanEqual(size, ivec2(2)));
    uint bucket = bucket_of(fm_nearest(t.z_least, t.z_most));
    return is_tiny ? (block.x + block.y * TILES_X) << NOTE_BLOCK | bucket << NOTE_BUCKET | covered : NOTE_AGAIN;
}

void count(uint triangle)
{
    fm_setup t;
    uint note = 0u; // nothing to do
    fm_parts(triangle);
    bool has_pixels = fm_set_up(t, 0u);
    ivec2 size = size_of(t);
    ivec2 each = is_small(size) ? size : LARGE_STRETCH;
    if (has_pixels && (is_small(size) || !put_off(triangle)))
        note = note_of(t, size, bin_part(t, triangle, size, each, ivec2(0, 1)));
    note_at(triangle) = note;
}

#else

void count(uint triangle)
{
    if (bin_triangle(triangle, false))
        put_off(triangle);
}

#endif
