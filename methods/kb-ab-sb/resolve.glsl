#if !FM_RESUMES
#define PLACES_READ_ONLY
#endif
#include "s-buffer/places.glsl"
#if FM_RESUMES
#include "common/select_in_runs.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    find_places(pixel, count);
    emit_nearest(pixel, count);
}
#else
#include "common/select.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    find_places(pixel, count);
    select_none();
    FM_LOOP for (uint i = 0u; i < count; ++i)
        select_nearest(fragment_at(pixel, i));
    emit_selected(pixel);
}
#endif
