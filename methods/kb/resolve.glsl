#include "kb/slots.glsl"

// Already in order. Where there are fewer slots than k, iteration i has the fragments from i SLOTS on.
void resolve(uvec2 pixel)
{
    uint first = fm_iteration * SLOTS, count = min(uint(SLOTS), uint(K) - first);
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        uvec2 fragment = kept_at(pixel, i);
        if (fragment.x == FM_EMPTY_BITS)
            break;
        fm_emit(pixel, int(first + i), uintBitsToFloat(fragment.x), fragment.y);
    }
}
