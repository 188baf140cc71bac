// Three levels of sums over blocks of BLOCK neighbours: level 0 are the pixels' counters, level l has a
// BLOCK-th of the elements of level l - 1. Any number of pixels: the last level is as long as it must be,
// 8 for 2 million pixels. sums[0] is the grand total; then lie levels 3, 2, 1.
const uint BLOCK = 64u, LEVELS = 3u;

uint level_length(uint level)
{
    uint length = uint(FM_PIXELS);
    FM_LOOP for (uint l = 0u; l < level; ++l)
        length = (length + BLOCK - 1u) / BLOCK;
    return length;
}

uint level_first(uint level)
{
    uint first = 1u;
    FM_LOOP for (uint l = LEVELS; l > level; --l)
        first += level_length(l);
    return first;
}
