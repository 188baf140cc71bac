#include "common/array.glsl"
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
#define SORT_CAPACITY K
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = 0u;
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uvec2 fragment = fragments[array_slot(pixel, i, K)];
        if (fragment.x != FM_EMPTY_BITS)
            sorted[count++] = fragment;
    }
    sort_fragments(count);
    emit_sorted(pixel, count);
}
#endif
