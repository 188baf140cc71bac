#include "kb-packed/pairs.glsl"

// As kb, a pair at a time: the new fragment sinks through the ascending list, what it displaces sinks on.
// Nothing keeps two fragments of a pixel apart.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 sinking = fm_pack(depth, colour);
    FM_LOOP for (uint i = 0u; i < PAIRS; ++i) {
        uvec4 pair = pair_at(pixel, i);
        if (sinking.x > pair.z)
            continue;
        put_pair(pixel, i, sinking.x <= pair.x ? uvec4(sinking, pair.xy) : uvec4(pair.xy, sinking));
        sinking = pair.zw;
    }
}
