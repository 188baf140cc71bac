#include "common/array.glsl"
#include "kplus-heap/max_heap.glsl"

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
    uint at = place(pixel, count, fragment);
    if (at == K)
        return;
    fragments[array_slot(pixel, at, K)] = fragment;
    if (count + 1u == K)
        fm_fence();
    if (count < K)
        counters[i] = count + 1u;
}
