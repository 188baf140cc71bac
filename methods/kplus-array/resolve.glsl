#include "common/array.glsl"
#ifndef SORT_CAPACITY
#define SORT_CAPACITY K
#endif
#include "common/sort.glsl"

// `count` fragments lie in the last slots.
void resolve(uvec2 pixel)
{
    uint count = counters[fm_pixel_index(pixel)];
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[array_slot(pixel, K - 1u - i, K)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
