// The store left the address behind the pixel's last fragment: the i-th counts back from there.
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[addresses[fm_pixel_index(pixel)] - 1u - i];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[addresses[fm_pixel_index(pixel)] - 1u - i] = fragment;
}
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    resolve_all(pixel, min(counters[fm_pixel_index(pixel)], N));
}
