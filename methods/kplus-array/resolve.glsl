#include "common/array.glsl"
#ifndef SORT_CAPACITY
#define SORT_CAPACITY K
#endif
#include "common/sort.glsl"

// Where the i-th of `count` fragments lies: in the last slots.
#ifndef SLOT_OF
#define SLOT_OF(i) (K - 1u - (i))
#endif

void resolve(uvec2 pixel)
{
    uint count = counters[fm_pixel_index(pixel)];
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[array_slot(pixel, SLOT_OF(i), K)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
