#include "s-buffer/per_pixel.glsl"
#include "s-buffer/place.glsl"

// The store left the address behind the pixel's last fragment: the i-th counts back from there. Where that
// fragment lies is found once for a pixel, by find_places(), before all else. A pass that only reads defines PLACES_READ_ONLY.
uint last_place;

void find_places(uvec2 pixel, uint count)
{
    last_place = count > 0u ? bin_place(pixel, address_of(pixel) - 1u) : 0u;
}
uint place_of(uvec2 pixel, uint i)
{
    return is_inverse(bin_of(pixel)) ? last_place + i : last_place - i;
}
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[place_of(pixel, i)];
}
#ifndef PLACES_READ_ONLY
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[place_of(pixel, i)] = fragment;
}
#endif
