#include "kplus-sb/slot.glsl"

// The paper's rule: where there are more than k fragments a heap if k > 16, else an array.
#define beats_farthest deep_beats_farthest
#define place deep_place
#if K > 16
#include "kplus-heap/max_heap.glsl"
#else
#include "kplus-array/max_array.glsl"
#endif
#undef beats_farthest
#undef place

// Where all fragments fit there is nothing to compare: they go one behind the other.
bool beats_farthest(uvec2 pixel, float depth)
{
    return !is_deep(pixel) || deep_beats_farthest(pixel, depth);
}

uint place(uvec2 pixel, uint count, uvec2 fragment)
{
    uint slot = count;
    if (is_deep(pixel))
        slot = deep_place(pixel, count, fragment);
    return slot;
}

#include "common/keep_nearest.glsl"
