#define SORT_CAPACITY K
#include "common/sort.glsl"

uvec2 routed_sample(uvec2 pixel, uint i)
{
#if K == 1
    return fm_load_routed(pixel).xy; // an image of one sample
#else
    return fm_load_routed(pixel, int(i)).xy;
#endif
}

void resolve(uvec2 pixel)
{
    uint count = 0u;
    FM_LOOP for (uint i = 0u; i < K; ++i) { // samples fill in the order of arrival
        sorted[i] = routed_sample(pixel, i);
        if (sorted[i].x == FM_EMPTY_BITS)
            break;
        ++count;
    }
    sort_fragments(count);
    emit_sorted(pixel, count);
}
