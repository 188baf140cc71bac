#include "common/array.glsl"
#define SORT_CAPACITY N
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[array_slot(pixel, i, N)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
