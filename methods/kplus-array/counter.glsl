// A pixel's word, in passes that no lock guards. After common/kept.glsl.
#include "common/nearest_word.glsl"

uint count_of(uvec2 pixel)
{
#if ARRAY_IS_IMAGE
    return count_in(fm_load_counters(pixel).x);
#else
    return count_in(counters[fm_pixel_index(pixel)]);
#endif
}

#ifdef FM_WRITES_COUNTERS
void count_none(uvec2 pixel)
{
#if ARRAY_IS_IMAGE
    fm_store_counters(pixel, uvec4(NONE_KEPT));
#else
    counters[fm_pixel_index(pixel)] = NONE_KEPT;
#endif
}
#endif
