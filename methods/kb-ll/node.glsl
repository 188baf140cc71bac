// Nodes as AB-LL has them. Each pixel has two sentinels, a head before all fragments and a tail behind them.
#include "ab-ll/nodes.glsl"

uint head_of(uvec2 pixel)
{
    return 2u * NODE_STEP * fm_pixel_index(pixel) + 1u;
}
