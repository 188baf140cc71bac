#include "common/array.glsl"

// Two fragments to an element, the nearer first; with an odd k the last element has a place to spare.
const uint PAIRS = (uint(K) + 1u) / 2u;

uint pair_slot(uvec2 pixel, uint i)
{
    return array_slot(pixel, i, PAIRS);
}
