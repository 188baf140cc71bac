#include "common/array.glsl"
#include "kb/slots.glsl"

// The new fragment sinks through the ascending list; what it displaces sinks on, and what falls out
// behind the last slot is returned.
uvec2 insert(uvec2 pixel, uvec2 sinking)
{
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i) {
        uint at = array_slot(pixel, i, SLOTS);
        uvec2 item = fragments[at];
        if (sinking.x <= item.x) {
            fragments[at] = sinking;
            sinking = item;
        }
    }
    return sinking;
}
