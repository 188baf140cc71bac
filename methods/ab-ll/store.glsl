#include "ab-ll/push.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    push(fm_pixel_index(pixel), depth, colour);
}
