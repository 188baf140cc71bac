#include "kplus-sb/slot.glsl"
#include "common/kept.glsl"

// The paper's rule: where there are more than k fragments a heap if k > 16, else an array.
#define place deep_place
#if K > 16
#include "kplus-heap/max_heap.glsl"
#else
#include "kplus-array/max_array.glsl"
#endif
#undef place

// Where all fragments fit there is nothing to compare: they go one behind the other.
#define OWN_FARTHEST
uint farthest_bits(uvec2 pixel)
{
    return is_deep(pixel) ? kept_bits_at(pixel, 0u) : FM_EMPTY_BITS;
}

uint place(uvec2 pixel, uint count, uvec2 fragment, inout uint farthest_bits)
{
    uint slot = count;
    if (is_deep(pixel))
        slot = deep_place(pixel, count, fragment, farthest_bits);
    return slot;
}

#include "common/keep_nearest.glsl"
