#include "precalc-scan/levels.glsl"

// Up: iteration i makes level i + 1 of level i, an invocation a block.
void sum(uint block)
{
    uint length = level_length(fm_iteration), from = level_first(fm_iteration);
    if (block >= level_length(fm_iteration + 1u))
        return;
    uint total = 0u, end = min((block + 1u) * BLOCK, length);
    FM_LOOP for (uint i = block * BLOCK; i < end; ++i)
        total += fm_iteration == 0u ? counters[i] : sums[from + i];
    sums[level_first(fm_iteration + 1u) + block] = total;
}
