#include "precalc-scan/levels.glsl"

// The last level in place, by one invocation; and the grand total.
void top(uint index)
{
    if (index > 0u)
        return;
    uint total = 0u, first = level_first(LEVELS), end = first + level_length(LEVELS);
    FM_LOOP for (uint i = first; i < end; ++i) {
        uint element = sums[i];
        sums[i] = total;
        total += element;
    }
    sums[0] = total;
}
