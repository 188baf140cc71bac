#include "ab-ll-paged/page.glsl"

void clear(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    heads[i] = END_OF_LIST;
    counters[i] = 0u;
    if (pixel == uvec2(0u)) {
        allocated[0] = 0u;
        allocated[1] = 0u;
    }
}
