#include "ab-ll/resolve_list.glsl"

void resolve(uvec2 pixel)
{
    resolve_list(pixel, fm_pixel_index(pixel), 0u);
}
