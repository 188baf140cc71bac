#include "kb-sr/samples.glsl"
#define SORT_CAPACITY SAMPLES
#include "common/sort.glsl"

// Where there are fewer samples than k, iteration i has the fragments from i SAMPLES on.
void resolve(uvec2 pixel)
{
    uint count = 0u, first = fm_iteration * SAMPLES;
    FM_LOOP for (uint i = 0u; i < SAMPLES; ++i) { // samples fill in the order of arrival
        sorted[i] = routed_sample(pixel, i);
        if (sorted[i].x == FM_EMPTY_BITS)
            break;
        ++count;
    }
    sort_fragments(count);
    count = min(count, uint(K) - first);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        fm_emit(pixel, int(first + i), uintBitsToFloat(sorted[i].x), sorted[i].y);
}
