// The i-th fragment of a pixel in an array of PLACES, as common/sort_in_place.glsl asks for it.
#ifndef PLACES
#define PLACES N
#endif

uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[array_slot(pixel, i, PLACES)];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[array_slot(pixel, i, PLACES)] = fragment;
}
