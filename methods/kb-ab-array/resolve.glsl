#include "common/array.glsl"
#if FM_RESUMES
#include "ab-array/places.glsl"
#include "common/select_in_runs.glsl"

void resolve(uvec2 pixel)
{
    emit_nearest(pixel, min(counters[fm_pixel_index(pixel)], N));
}
#else
#include "common/select.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    select_none();
    FM_LOOP for (uint i = 0u; i < count; ++i)
        select_nearest(fragments[array_slot(pixel, i, N)]);
    emit_selected(pixel);
}
#endif
