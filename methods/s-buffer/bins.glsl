// S shared counters. bins[0..S-1]: C, how many fragments the pixels of each counter have;
// bins[S..2S-1]: where each counter's stretch of the pool begins, its prefix sum.
// A method without these options has one counter, the paper's hash and forward mapping.
#ifdef COUNTERS
const uint S = uint(COUNTERS);
#else
const uint S = 1u;
#endif

uint bin_of(uvec2 pixel)
{
#if defined(HASH_TILED) && HASH == HASH_TILED
    const uvec2 tile_px = uvec2(256u, 96u); // the authors' code
    uvec2 tile = pixel / tile_px;
    uint tiles_down = (uint(FM_HEIGHT) + tile_px.y - 1u) / tile_px.y;
    return (tile.x * tiles_down + tile.y) % S;
#else
    return fm_pixel_index(pixel) % S; // (x + W y) mod S
#endif
}

// Inverse mapping: the second group of counters, G2, fills the pool from its end downward.
bool is_inverse(uint bin)
{
#if defined(MAPPING_INVERSE) && MAPPING == MAPPING_INVERSE
    return bin > S / 2u;
#else
    return false;
#endif
}
