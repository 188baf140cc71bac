#include "peer-spinlock/slot.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = counters[fm_pixel_index(pixel)];
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[slot_of(pixel, i)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
