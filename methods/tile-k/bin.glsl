// A triangle's tiles, each by an exact test of its edges. Who includes this defines
//   void put(uint tile, uint bucket, uint pair)   what happens to a pair
//   void put_off(uint triangle)                   a triangle with a large part: for the list
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

void put(uint tile, uint bucket, uint pair);
void put_off(uint triangle);

// Tiles first, first + stride, ... of its box.
void bin_part(fm_setup t, uint pair, uint first, uint stride)
{
    ivec4 box = t.box >> 3;
    uint across = uint(box.z - box.x) + 1u, count = across * (uint(box.w - box.y) + 1u);
    uint bucket = bucket_of(t.z_least);
    FM_LOOP for (uint i = first; i < count; i += stride) {
        ivec2 tile = box.xy + ivec2(i % across, i / across);
        if (fm_may_cover(t, fm_edges_at(t, tile * 8), ivec2(8)))
            put(uint(tile.y) * TILES_X + uint(tile.x), bucket, pair);
    }
}

bool is_large(fm_setup t)
{
    ivec4 box = t.box >> 3;
    return uint(box.z - box.x + 1) * uint(box.w - box.y + 1) > SMALL_TILES;
}

void bin_small(uint triangle)
{
    fm_setup t;
    read_range();
    uint parts = fm_parts(triangle);
    bool any_large = false;
    FM_LOOP for (uint part = 0u; part < parts; ++part) {
        if (!fm_set_up(t, part))
            continue;
        if (is_large(t))
            any_large = true;
        else
            bin_part(t, triangle | part << PART_SHIFT, 0u, 1u);
    }
    if (any_large)
        put_off(triangle);
}

// By all lanes of a workgroup.
void bin_large(uint triangle, uint lane)
{
    fm_setup t;
    read_range();
    uint parts = fm_parts(triangle);
    FM_LOOP for (uint part = 0u; part < parts; ++part)
        if (fm_set_up(t, part) && is_large(t))
            bin_part(t, triangle | part << PART_SHIFT, lane, uint(FM_GROUP_LANES));
}
