#if FM_RESUMES
#define PLACES K
#include "ab-array/places.glsl"
#define SORT_MOST K
#include "common/sort_in_place.glsl"

void resolve(uvec2 pixel)
{
    emit_in_place(pixel, min(arrivals[fm_pixel_index(pixel)], K));
}
#else
#include "common/kept.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(arrivals[fm_pixel_index(pixel)], K);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = kept_at(pixel, i);
    sort_fragments(count);
    emit_sorted(pixel, count);
}
#endif
