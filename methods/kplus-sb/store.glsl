#include "kplus-sb/slot.glsl"

// The paper's rule: where there are more than k fragments a heap if k > 16, else an array.
#if K > 16
#include "kplus-heap/max_heap.glsl"
#else
#include "kplus-array/max_array.glsl"
#endif

bool wanted(uvec2 pixel, float depth)
{
    return !is_deep(pixel) || beats_farthest(pixel, depth);
}

// Where all fragments fit there is nothing to compare: they go one behind the other.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    uint slot = count;
    if (is_deep(pixel))
        slot = place(pixel, count, fragment);
    if (slot == K)
        return;
    fragments[array_slot(pixel, slot, K)] = fragment;
    if (count + 1u == K)
        fm_fence(); // who reads a full heap's count reads its root of that time or later
    if (count < K)
        counters[i] = count + 1u;
}
