#include "peer-array/record.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

// Where the i-th of a pixel's records lies: in the last slots.
#ifndef SLOT_OF
#define SLOT_OF(i) (K - 1u - (i))
#endif

void resolve(uvec2 pixel)
{
    uint count = fm_load_counters(pixel).x;
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = record_at(pixel, SLOT_OF(i));
    sort_fragments(count);
    emit_sorted(pixel, count);
}
