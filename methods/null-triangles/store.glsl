// Every triangle of the block is tested, and set up if its box touches the subgroup's pixels; every fragment's
// depth and number are consumed, none is kept.
#define MAY_RESUME false
#include "tile-k/scan.glsl"

uvec2 own_pixel;

bool is_full()
{
    return false;
}
void advance(uint bucket)
{
}
bool is_short()
{
    return false;
}
// Depth bits never exceed those of 1, but no compiler knows.
void take(uvec2 key)
{
    if (key.y + own_pixel.x + own_pixel.y > 0x7FFFFFFFu)
        sink[0] = key.x;
}

void store(uint i)
{
    uint tile;
    begin_counting();
    if (!tile_of(i, tile))
        return;
    own_pixel = uvec2(tile % TILES_X, tile / TILES_X) * 8u + pixel_in_tile(this_place());
    uint bin = own_bin(tile);
    scan(bin, bins[words_of(bin) + BUCKETS], own_pixel);
}
