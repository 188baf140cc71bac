#include "common/array.glsl"

// The new fragment sinks through the ascending list; what it displaces sinks on. As published nothing
// keeps two fragments of a pixel apart: both may read the same list, and then one of them is lost or
// doubled. The published code reads all k targets, then writes all k; here what does not change is
// not written back.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 sinking = fm_pack(depth, colour);
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uint at = array_slot(pixel, i, K);
        uvec2 item = fragments[at];
        if (sinking.x <= item.x) {
            fragments[at] = sinking;
            sinking = item;
        }
    }
}
