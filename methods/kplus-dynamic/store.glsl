#include "kplus-dynamic/chosen.glsl"
#include "kplus-dynamic/kept_in.glsl"
#include "common/array.glsl"

// Both of its relatives', under names of their own.
#define beats_farthest array_beats_farthest
#define place array_place
#include "kplus-array/max_array.glsl"
#undef beats_farthest
#undef place
#define beats_farthest heap_beats_farthest
#define place heap_place
#include "kplus-heap/max_heap.glsl"
#undef beats_farthest
#undef place

bool beats_farthest(uvec2 pixel, float depth)
{
    return in_heap() ? heap_beats_farthest(pixel, depth) : array_beats_farthest(pixel, depth);
}

uint place(uvec2 pixel, uint count, uvec2 fragment)
{
    return in_heap() ? heap_place(pixel, count, fragment) : array_place(pixel, count, fragment);
}

#include "common/keep_nearest.glsl"
