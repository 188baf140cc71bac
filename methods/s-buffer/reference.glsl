#include "s-buffer/bins.glsl"
#include "s-buffer/per_pixel.glsl"

// Records that a pixel gets: all its fragments, unless the method bounds them.
#ifndef RECORDS
#define RECORDS(count) (count)
#endif

// A_local: the pixel's first place in its counter's stretch.
void reference(uvec2 pixel)
{
    uint records = RECORDS(count_of(pixel));
    if (records > 0u) { // pixels of one counter collide; each gets its own part of the stretch
        uint address = atomicAdd(bins[bin_of(pixel)], records);
        set_address(pixel, address);
    }
}
