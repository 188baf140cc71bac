// A pass is a k+-buffer of SLOTS places: K is that from here on, and K_WANTED what all passes are to hand over.
const uint K_WANTED = uint(K);
#undef K
#define K SLOTS
#include "common/kept.glsl"

// boundary[i], between passes: bits of depth and colour of the farthest fragment that pixel i has handed over,
// copies of it that were, and copies of it that have come again in this pass. Infinity: nothing is left.

// Depth and then colour put a pixel's fragments in one order, in which only copies, which nobody can tell apart, tie.
bool is_farther(uvec2 one, uvec2 other)
{
    return one.x > other.x || (one.x == other.x && one.y > other.y);
}
#define IS_FARTHER(one, other) is_farther(one, other)
