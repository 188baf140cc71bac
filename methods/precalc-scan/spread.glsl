#include "precalc-scan/levels.glsl"

// Down: each block of level 2, then 1, then 0 goes on from its prefix one level up. Level 0 are the
// pixels' addresses.
void spread(uint block)
{
    uint level = LEVELS - 1u - fm_iteration, length = level_length(level), to = level_first(level);
    if (block >= level_length(level + 1u))
        return;
    uint prefix = sums[level_first(level + 1u) + block], end = min((block + 1u) * BLOCK, length);
    FM_LOOP for (uint i = block * BLOCK; i < end; ++i) {
        uint element = level == 0u ? counters[i] : sums[to + i];
        if (level == 0u)
            addresses[i] = prefix;
        else
            sums[to + i] = prefix;
        prefix += element;
    }
}
