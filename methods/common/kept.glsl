// The array `fragments` of a pixel's records, depth bits and colour: KEPT_PLACES of them, K unless it is defined.
#include "common/array.glsl"
#ifndef KEPT_PLACES
#define KEPT_PLACES K
#endif

uvec2 kept_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_fragments(pixel, i).xy;
#else
    return fragments[array_slot(pixel, i, KEPT_PLACES)];
#endif
}

uint kept_bits_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_fragments(pixel, i).x;
#else
    return fragments[array_slot(pixel, i, KEPT_PLACES)].x;
#endif
}

#ifdef FM_WRITES_FRAGMENTS
void keep_at(uvec2 pixel, uint i, uvec2 fragment)
{
#if ARRAY_IS_IMAGE
    fm_store_fragments(pixel, i, uvec4(fragment, 0u, 0u));
#else
    fragments[array_slot(pixel, i, KEPT_PLACES)] = fragment;
#endif
}
#endif
