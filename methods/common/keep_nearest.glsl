// Bounded k+-buffers: wanted() and store() over beats_farthest() and place(), of the max-array or the
// max-heap.

// Section 3.2, fragment culling: only what is nearer than the farthest kept one enters the section.
bool wanted(uvec2 pixel, float depth)
{
    return beats_farthest(pixel, depth);
}

// All ways to store end in one write, since software rasterisers run both sides of every branch.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    uint slot = place(pixel, count, fragment);
    if (slot == K)
        return;
    fragments[array_slot(pixel, slot, K)] = fragment;
    if (count + 1u == K)
        fm_fence(); // who reads a full heap's count reads its root of that time or later
    if (count < K)
        counters[i] = count + 1u;
}
