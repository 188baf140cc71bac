uvec2 fragment_at(uvec2 pixel, uint i)
{
    return fragments[offsets[fm_pixel_index(pixel)] + i];
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    fragments[offsets[fm_pixel_index(pixel)] + i] = fragment;
}
#include "common/sort_in_place.glsl"

void resolve(uvec2 pixel)
{
    emit_in_place(pixel, counters[fm_pixel_index(pixel)]);
}
