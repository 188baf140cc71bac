// Pairs into their bins: an invocation for each small triangle, then a workgroup for each large one.
// Within a bin any order is right.
#include "tile-k/bin.glsl"

void put(uint bin, uint bucket, uint pair)
{
    uint at = atomicAdd(bins[words_of(bin) + bucket], 1u); // collide; each gets its own place
    if (at < fm_length_pairs) // else the frame is run again with more of them
        pairs[at] = pair;
}

#if TAKES_NOTES

void put_noted(uint triangle, uint note)
{
    uint block = note >> NOTE_BLOCK, bucket = note >> NOTE_BUCKET & (BUCKETS - 1u);
    ivec2 first = ivec2(block % TILES_X, block / TILES_X);
    for (int i = 0; i < 4; ++i)
        if ((note >> i & 1u) != 0u)
            put(bin_of(first + ivec2(i & 1, i >> 1)), bucket, triangle);
}

void bin_again(uint triangle, ivec2 first_and_stride)
{
    fm_setup t;
    fm_parts(triangle);
    fm_set_up(t, 0u);
    ivec2 size = size_of(t);
    bin_part(t, triangle, size, is_small(size) ? size : LARGE_STRETCH, first_and_stride);
}

void fill(uint i)
{
    uint group = i / uint(FM_GROUP_LANES), at = group - SMALL_GROUPS;
    bool is_listed = group >= SMALL_GROUPS && at < large_count();
    uint note = i < uint(FM_TRIANGLES) && group < SMALL_GROUPS ? note_at(i) : 0u;
    if (is_listed || note == NOTE_AGAIN)
        bin_again(is_listed ? large_at(at) : i, is_listed ? ivec2(fm_lane, FM_GROUP_LANES) : ivec2(0, 1));
    else if (note != 0u)
        put_noted(i, note);
}

#else

void fill(uint i)
{
    uint group = i / uint(FM_GROUP_LANES), at = group - SMALL_GROUPS;
    bool is_large = group >= SMALL_GROUPS;
    uint triangle = !is_large ? i : at < large_count() ? large_at(at) : uint(FM_TRIANGLES);
    if (triangle < uint(FM_TRIANGLES))
        bin_triangle(triangle, is_large);
}

#endif
