#include "common/array.glsl"

// Read all k, let the new fragment sink to its place, write all k back. As published nothing keeps two
// fragments of a pixel apart: both may read the same list, and then one of them is lost or doubled.
void store(uvec2 pixel, float depth, uint colour)
{
    uvec2 nearest[K];
    uvec2 sinking = fm_pack(depth, colour);
    FM_LOOP for (uint i = 0u; i < K; ++i)
        nearest[i] = fragments[array_slot(pixel, i, K)];
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uvec2 item = nearest[i];
        bool is_nearer = sinking.x <= item.x;
        nearest[i] = is_nearer ? sinking : item;
        sinking = is_nearer ? item : sinking;
    }
    FM_LOOP for (uint i = 0u; i < K; ++i)
        fragments[array_slot(pixel, i, K)] = nearest[i];
}
