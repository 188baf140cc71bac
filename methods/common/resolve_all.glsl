// All fragments of a pixel in order: copied to a private array and sorted there, as published, or as the method's option
// sort says; where that array would be too long, sorted where they lie. The method defines fragment_at() and
// put_fragment() as sort_in_place.glsl asks for them.
#include "common/sort_limit.glsl"
#if SORTS_IN_PLACE
#include "common/sort_in_place.glsl"
#elif !SORTS_BY_NETWORK
#define SORT_CAPACITY N
#include "common/sort.glsl"
#endif

void resolve_all(uvec2 pixel, uint count)
{
#if SORTS_BY_NETWORK
    emit_by_network(pixel, 0u, count, 0u, count);
#elif SORTS_IN_PLACE
    emit_in_place(pixel, count);
#else
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = fragment_at(pixel, i);
    sort_fragments(count);
    emit_sorted(pixel, count);
#endif
}
