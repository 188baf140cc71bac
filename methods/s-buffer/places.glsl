#include "s-buffer/place.glsl"

// The store left the address behind the pixel's last fragment: the i-th counts back from there.
uint place_of(uvec2 pixel, uint i)
{
    return bin_place(pixel, addresses[fm_pixel_index(pixel)] - 1u - i);
}
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[place_of(pixel, i)];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[place_of(pixel, i)] = fragment;
}
