#include "kplus-multipass/slots.glsl"

// As kplus-array in each pass. Before the first one nothing was handed over, and nothing lies before depth 0.
void clear(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    counters[i] = 0u;
    keep_at(pixel, 0u, uvec2(FM_EMPTY_BITS, 0u));
    if (fm_iteration == 0u)
        boundary[i] = uvec4(0u);
}
