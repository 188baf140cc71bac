#include "kb/slots.glsl"

// The new fragment sinks through the ascending list; what it displaces sinks on, and what falls out
// behind the last slot is returned.
uvec2 insert(uvec2 pixel, uvec2 sinking)
{
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i) {
        uvec2 item = kept_at(pixel, i);
        if (sinking.x <= item.x) {
            keep_at(pixel, i, sinking);
            sinking = item;
        }
    }
    return sinking;
}
