#include "ab-array/places.glsl"
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    resolve_all(pixel, min(counters[fm_pixel_index(pixel)], N));
}
