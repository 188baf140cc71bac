#include "kplus-multipass/slots.glsl"
#define SORT_CAPACITY K
#include "common/sort.glsl"

// Pass i hands over the fragments from i SLOTS on, in the last slots of the array.
void resolve(uvec2 pixel)
{
    uint first = fm_iteration * K, count = counters[fm_pixel_index(pixel)];
    FM_LOOP for (uint i = 0u; i < count; ++i)
        sorted[i] = kept_at(pixel, K - 1u - i);
    sort_fragments(count);
    count = min(count, K_WANTED - first);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        fm_emit(pixel, int(first + i), uintBitsToFloat(sorted[i].x), sorted[i].y);
}
