// The array `fragments` of a pixel's K records, depth bits and colour.
#include "common/array.glsl"

uvec2 kept_at(uvec2 pixel, uint i)
{
    return fragments[array_slot(pixel, i, K)];
}

uint kept_bits_at(uvec2 pixel, uint i)
{
    return fragments[array_slot(pixel, i, K)].x;
}

// No function: passes that only read could not have it.
#define keep_at(pixel, i, fragment) fragments[array_slot(pixel, i, K)] = fragment
