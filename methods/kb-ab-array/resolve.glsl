#if FM_RESUMES
#include "ab-array/places.glsl"
#include "common/select_in_runs.glsl"

void resolve(uvec2 pixel)
{
    emit_nearest(pixel, min(counters[fm_pixel_index(pixel)], N));
}
#else
#define KEPT_PLACES N
#include "common/kept.glsl"
#include "common/select.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    select_none();
    FM_LOOP for (uint i = 0u; i < count; ++i)
        select_nearest(kept_at(pixel, i));
    emit_selected(pixel);
}
#endif
