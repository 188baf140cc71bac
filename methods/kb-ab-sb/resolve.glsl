#if FM_RESUMES
#include "s-buffer/places.glsl"
#include "common/select_in_runs.glsl"

void resolve(uvec2 pixel)
{
    emit_nearest(pixel, min(counters[fm_pixel_index(pixel)], N));
}
#else
#include "s-buffer/place.glsl"
#include "common/select.glsl"

// The store left the address behind the pixel's last fragment.
void resolve(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint count = min(counters[i], N), end = count > 0u ? addresses[i] : 0u;
    FM_LOOP for (uint back = 0u; back < count; ++back)
        select_nearest(fragments[bin_place(pixel, end - 1u - back)]);
    emit_selected(pixel);
}
#endif
