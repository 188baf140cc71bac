#include "ab-ll/node.glsl"

void clear(uvec2 pixel)
{
    heads[fm_pixel_index(pixel)] = END_OF_LIST;
    if (pixel == uvec2(0u)) {
        allocated[0] = 0u;
        allocated[1] = 0u;
    }
}
