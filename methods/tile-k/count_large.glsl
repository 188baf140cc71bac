// A workgroup for each large triangle.
#include "tile-k/count_pair.glsl"

void count_large(uint i)
{
    uint at = i / uint(FM_GROUP_LANES);
    if (at < large_count())
        bin_triangle(large_at(at), true);
}
