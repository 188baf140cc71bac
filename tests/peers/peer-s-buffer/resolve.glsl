#include "peer-s-buffer/bins.glsl"

// The store left the address behind the pixel's last fragment: the i-th counts back from there.
uint place_of(uvec2 pixel, uint i)
{
    return bins[S + bin_of(pixel)] + fm_load_addresses(pixel).x - 1u - i;
}
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[place_of(pixel, i)];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[place_of(pixel, i)] = fragment;
}
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    resolve_all(pixel, min(fm_load_counters(pixel).x, N));
}
