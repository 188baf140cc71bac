#include "peer-s-buffer/bins.glsl"

void reference(uvec2 pixel)
{
    uint count = fm_load_counters(pixel).x;
    if (count > 0u) // pixels of one counter collide; each gets its own part of the stretch
        fm_store_addresses(pixel, uvec4(atomicAdd(bins[bin_of(pixel)], count)));
}
