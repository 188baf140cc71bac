// Between which depths the scene lies, from a sample of its triangles: buckets divide that range.
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

// As many as there are tiles, 1024 at most: more would wait for each other at two words.
const uint TILES = TILES_X * ((uint(FM_HEIGHT) + 7u) / 8u);
const uint SAMPLES = min(min(TILES, 1024u), uint(FM_TRIANGLES));

void range_of_depths(uint i)
{
    fm_setup t;
    if (i >= SAMPLES)
        return;
    uint parts = fm_parts(i * (uint(FM_TRIANGLES) / SAMPLES));
    FM_LOOP for (uint part = 0u; part < parts; ++part)
        if (fm_set_up(t, part)) { // the extremes of all: any order is right
            uint bits = floatBitsToUint(t.z_least) & 0x7FFFFFFFu;
            atomicMax(groups[LEAST], ~bits);
            atomicMax(groups[MOST], bits);
        }
}
