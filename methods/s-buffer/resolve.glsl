#include "s-buffer/places.glsl"
#include "common/resolve_all.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(count_of(pixel), N);
    find_places(pixel, count);
    resolve_all(pixel, count);
}
