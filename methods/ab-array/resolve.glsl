#include "common/array.glsl"

uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[array_slot(pixel, i, N)];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[array_slot(pixel, i, N)] = fragment;
}
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    resolve_all(pixel, min(counters[fm_pixel_index(pixel)], N));
}
