// The i-th fragment of a pixel in an array of PLACES, as common/sort_in_place.glsl asks for it.
#ifndef PLACES
#define PLACES N
#endif
#define KEPT_PLACES PLACES
#include "common/kept.glsl"

uvec2 fragment_at(uvec2 pixel, uint i)
{
    return kept_at(pixel, i);
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    keep_at(pixel, i, fragment);
}
