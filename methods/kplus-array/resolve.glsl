#include "common/kept.glsl"
#include "kplus-array/counter.glsl"

// Where the i-th of `count` fragments lies: in the last slots.
#ifndef SLOT_OF
#define SLOT_OF(i) (K - 1u - (i))
#endif

#if FM_RESUMES // so many would take more iterations than the device allows: in runs, where they lie
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return kept_at(pixel, SLOT_OF(i));
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    keep_at(pixel, SLOT_OF(i), fragment);
}
#define SORT_MOST K
#include "common/sort_in_place.glsl"

void resolve(uvec2 pixel)
{
    emit_in_place(pixel, count_of(pixel));
}
#else
#ifndef SORT_CAPACITY
#define SORT_CAPACITY K
#endif
#include "common/sort.glsl"

void resolve(uvec2 pixel)
{
    uint count = count_of(pixel);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = kept_at(pixel, SLOT_OF(i));
    sort_fragments(count);
    emit_sorted(pixel, count);
}
#endif
