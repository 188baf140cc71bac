// Sort and composite: as the paper's second pass. A pixel's arrays lie layer by layer.
uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[i * uint(FM_PIXELS) + fm_pixel_index(pixel)];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[i * uint(FM_PIXELS) + fm_pixel_index(pixel)] = fragment;
}
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    resolve_all(pixel, min(counters[fm_pixel_index(pixel)], uint(N)));
}
