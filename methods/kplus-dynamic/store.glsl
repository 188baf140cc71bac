#include "kplus-dynamic/chosen.glsl"
#include "kplus-dynamic/kept_in.glsl"
#include "common/kept.glsl"

// Both of its relatives', under names of their own.
#define place array_place
#include "kplus-array/max_array.glsl"
#undef place
#define place heap_place
#include "kplus-heap/max_heap.glsl"
#undef place

uint place(uvec2 pixel, uint count, uvec2 fragment, inout uint farthest_bits)
{
    return in_heap() ? heap_place(pixel, count, fragment, farthest_bits)
                     : array_place(pixel, count, fragment, farthest_bits);
}

#include "common/keep_nearest.glsl"
