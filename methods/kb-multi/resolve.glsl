#if FM_RESUMES
#define PLACES K
#include "ab-array/places.glsl"
#define SORT_MOST K
#include "common/sort_in_place.glsl"

void resolve(uvec2 pixel)
{
    emit_in_place(pixel, uint(K));
}
#else
#include "common/kept.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = 0u;
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uvec2 fragment = kept_at(pixel, i);
        if (fragment.x != FM_EMPTY_BITS)
            sorted[count++] = fragment;
    }
    sort_fragments(count);
    emit_sorted(pixel, count);
}
#endif
