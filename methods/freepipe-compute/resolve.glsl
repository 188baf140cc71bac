// Sort and composite: as the paper's second pass.
#define SORT_CAPACITY N
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint at = fm_pixel_index(pixel), count = min(counters[at], uint(N));
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragments[i * uint(FM_PIXELS) + at];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
