// A triangle's blocks, each by an exact test of its edges. Who includes this defines
//   void put(uint bin, uint bucket, uint pair)   what happens to a pair
#include "common/rasterise.glsl"
#include "tile-k/layout.glsl"

void put(uint bin, uint bucket, uint pair);

// Blocks first, first + stride, ... of its box, which has `across` columns and `count` in all.
void bin_part(fm_setup t, uint pair, uvec2 blocks, uvec2 first_and_stride)
{
    ivec2 corner = t.box.xy >> BLOCK_SHIFT;
    uint bucket = bucket_of(t.z_least);
    FM_LOOP for (uint i = first_and_stride.x; i < blocks.y; i += first_and_stride.y) {
        ivec2 block = corner + ivec2(i % blocks.x, i / blocks.x);
        if (fm_may_cover(t, fm_edges_at(t, block << BLOCK_SHIFT), BLOCK_PX))
            put(bin_of(block), bucket, pair);
    }
}

// Columns and blocks of its box.
uvec2 blocks_of(fm_setup t)
{
    ivec2 size = (t.box.zw >> BLOCK_SHIFT) - (t.box.xy >> BLOCK_SHIFT) + 1;
    return uvec2(size.x, size.x * size.y);
}

// The parts that are large, or those that are not; whether there were others.
bool bin_triangle(uint triangle, bool wants_large, uvec2 first_and_stride)
{
    fm_setup t;
    bool has_others = false;
    uint parts = fm_parts(triangle);
    FM_LOOP for (uint part = 0u; part < parts; ++part) {
        if (!fm_set_up(t, part))
            continue;
        uvec2 blocks = blocks_of(t);
        if ((blocks.y > SMALL_BLOCKS) == wants_large)
            bin_part(t, triangle | part << PART_SHIFT, blocks, first_and_stride);
        else
            has_others = true;
    }
    return has_others;
}
