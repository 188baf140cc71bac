#include "s-buffer/places.glsl"
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    find_places(pixel, count);
    resolve_all(pixel, count);
}
