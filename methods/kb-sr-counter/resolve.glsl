#include "common/array.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(arrivals[fm_pixel_index(pixel)], K);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[array_slot(pixel, i, K)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
