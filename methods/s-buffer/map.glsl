#include "s-buffer/bins.glsl"

bool begins_group(uint bin)
{
    return is_inverse(bin) && !is_inverse(bin - 1u);
}

// C_pr: each counter's prefix sum over its group, by one invocation, as the paper has it: O(S).
// Where pixels are fewer than counters an invocation goes on with the next of its own.
void map(uvec2 pixel)
{
    uint sum = 0u, next = 0u;
    FM_LOOP for (uint bin = fm_pixel_index(pixel); bin < S; bin += uint(FM_PIXELS)) {
        FM_LOOP for (; next < bin; ++next)
            sum = begins_group(next + 1u) ? 0u : sum + bins[next];
        bins[S + bin] = sum;
    }
}
