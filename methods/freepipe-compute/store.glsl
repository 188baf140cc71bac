// One invocation a triangle rasterises all of it, pixel after pixel, and appends each fragment to its
// pixel's array by an atomic counter: FreePipe's A-buffer. Mesa's software ends the loops of an
// invocation after FM_LOOP_LIMIT iterations, so there a triangle is done in stretches: the pass runs
// again until no triangle has tiles left.
#include "common/rasterise.glsl"

#if FM_LOOP_LIMIT
const uint TILES_AT_ONCE = uint(FM_LOOP_LIMIT) / 100u; // 64 pixels, and what ends the loops
#else
const uint TILES_AT_ONCE = 1u << 14; // no dispatch should take seconds
#endif

void append(uvec2 pixel, uint depth, uint triangle)
{
    uint at = fm_pixel_index(pixel);
    uint i = atomicAdd(counters[at], 1u); // fragments of a pixel collide; each gets its own place
    if (i < fm_length_fragments / uint(FM_PIXELS))
        fragments[i * uint(FM_PIXELS) + at] = uvec2(depth, fm_triangle_colour(triangle));
    else
        fm_lost(pixel);
}

void rasterise_tile(fm_setup t, ivec2 corner, uint triangle)
{
    ivec3 edges = fm_edges_at(t, corner);
    if (!fm_may_cover(t, edges, ivec2(8)))
        return;
    FM_LOOP for (int i = 0; i < 64; ++i) {
        ivec2 at = ivec2(i & 7, i >> 3), pixel = corner + at;
        ivec3 inside = edges + t.a * at.x + t.b * at.y;
        if ((inside.x | inside.y | inside.z) < 0 || any(greaterThan(pixel, t.box.zw)))
            continue;
        uint depth = fm_depth_bits(pixel, vec2(t.x[0], t.y[0]), t.z, t.dz_dx, t.dz_dy, t.z_least,
                                   t.z_most);
        if (fm_triangle_lives(triangle, uvec2(pixel)))
            append(uvec2(pixel), depth, triangle);
    }
}

void store(uint triangle)
{
    fm_setup t;
    uint parts = fm_parts(triangle), seen = 0u, first = fm_iteration * TILES_AT_ONCE;
    FM_LOOP for (uint part = 0u; part < parts; ++part) {
        if (!fm_set_up(t, part))
            continue;
        ivec4 box = t.box >> 3;
        uint across = uint(box.z - box.x) + 1u, count = across * (uint(box.w - box.y) + 1u);
        uint from = max(first, seen), to = min(first + TILES_AT_ONCE, seen + count);
        FM_LOOP for (uint i = from; i < to; ++i) {
            uint tile = i - seen;
            rasterise_tile(t, (box.xy + ivec2(tile % across, tile / across)) * 8, triangle);
        }
        seen += count;
    }
    if (seen > first + TILES_AT_ONCE)
        atomicAdd(unfinished[0], 1u); // a sum
}
