#include "s-buffer/bins.glsl"

// Records that a pixel gets: all its fragments, unless the method bounds them.
#ifndef RECORDS
#define RECORDS(count) (count)
#endif

// A_local: the pixel's first place in its counter's stretch.
void reference(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint records = RECORDS(counters[i]);
    if (records > 0u) // pixels of one counter collide; each gets its own part of the stretch
        addresses[i] = atomicAdd(bins[bin_of(pixel)], records);
}
