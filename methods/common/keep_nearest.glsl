// Bounded k+-buffers: wanted() and store() over place(), of the max-array or the max-heap. A fragment must beat
// slot 0: infinity until there are K, then the farthest of them. Who takes the lock knows as much from its word,
// and reads neither slot 0 nor a counter.
#include "common/nearest_word.glsl"

#ifndef OWN_FARTHEST
uint farthest_bits(uvec2 pixel)
{
    return kept_bits_at(pixel, 0u);
}
#endif

// Section 3.2, fragment culling: only what is nearer than the farthest kept one enters the section. Read
// without the lock: slot 0 only ever comes nearer, so a stale value culls too little, never too much;
// store() tests again. The word would tell it, too, but waits for those who take the lock.
bool wanted(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < farthest_bits(pixel);
}

bool still_wanted(uint word, float depth)
{
    return fm_pack(depth, 0u).x < word;
}

// All ways to store end in one write, since software rasterisers run both sides of every branch.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour);
    uint word = fm_lock_word(pixel), count = count_in(word), farthest = fragment.x;
    if (fragment.x >= word)
        return;
    keep_at(pixel, place(pixel, count, fragment, farthest), fragment);
    fm_set_lock_word(pixel, count + 1u < K ? word - 1u : farthest);
}
