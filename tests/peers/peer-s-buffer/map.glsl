#include "peer-s-buffer/bins.glsl"

// A counter's prefix sum by one invocation: O(S).
void map(uvec2 pixel)
{
    uint sum = 0u, next = 0u;
    FM_LOOP for (uint bin = fm_pixel_index(pixel); bin < S; bin += uint(FM_PIXELS)) {
        FM_LOOP for (; next < bin; ++next)
            sum += bins[next];
        bins[S + bin] = sum;
    }
}
