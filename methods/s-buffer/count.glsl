#include "s-buffer/per_pixel.glsl"

void store(uvec2 pixel, float depth, uint colour)
{
    add_to_count(pixel); // a sum: the order of arrival does not matter
}
