// Bounded k+-buffers: wanted() and store() over place(), of the max-array or the max-heap. Slot 0 is what a
// fragment must beat: infinity until there are K, then the farthest of them. So a full pixel's counter is not read.
#ifndef OWN_FARTHEST
uint farthest_bits(uvec2 pixel)
{
    return kept_bits_at(pixel, 0u);
}
#endif

// Section 3.2, fragment culling: only what is nearer than the farthest kept one enters the section. Read
// without the lock: slot 0 only ever comes nearer, so a stale value culls too little, never too much;
// store() tests again.
bool wanted(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < farthest_bits(pixel);
}

// All ways to store end in one write, since software rasterisers run both sides of every branch.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 fragment = fm_pack(depth, colour);
    uint i = fm_pixel_index(pixel), count = K, farthest = farthest_bits(pixel);
    if (fragment.x >= farthest)
        return;
    if (farthest == FM_EMPTY_BITS) {
        count = counters[i];
        counters[i] = count + 1u;
    }
    keep_at(pixel, place(pixel, count, fragment), fragment);
}
