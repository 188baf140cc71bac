#include "dual/peel.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    peel(pixel, depth, colour);
}
