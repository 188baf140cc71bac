#include "common/array.glsl"

// Two fragments to an element, the nearer first; with an odd k the last element has a place to spare.
const uint PAIRS = (uint(K) + 1u) / 2u;

uvec4 pair_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_pairs(pixel, i);
#else
    return pairs[array_slot(pixel, i, PAIRS)];
#endif
}

#ifdef FM_WRITES_PAIRS
void put_pair(uvec2 pixel, uint i, uvec4 pair)
{
#if ARRAY_IS_IMAGE
    fm_store_pairs(pixel, i, pair);
#else
    pairs[array_slot(pixel, i, PAIRS)] = pair;
#endif
}
#endif
