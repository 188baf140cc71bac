// A chunk of triangles against a block of as many pixels, where reading memory is what costs: lane =
// triangle computes the depths at all pixels of the block, and lane = pixel reads those of its own
// triangles.
shared uint depths[FM_GROUP_LANES * LANES]; // [subgroup][pixel][triangle]
shared uint numbers[FM_GROUP_LANES];

// Bit j of `own`: triangle j covers this lane's pixel.
void take_next(uint own, uint base, uvec2 pixel)
{
    uint lane = own != 0u ? uint(findLSB(own)) : 0u;
    uint number = numbers[base + lane];
    if (own != 0u && fm_triangle_lives(number, pixel))
        take(uvec2(number, depths[this_place() * uint(LANES) + lane]));
}

void scan_chunk(lane_triangle mine, uvec2 pixel, ivec2 corner)
{
    uint base = this_place() - this_lane(), own = 0u;
    subgroup_fence(); // the last chunk's have been read
    numbers[this_place()] = mine.number;
    for (uint i = 0u; i < uint(LANES); ++i) {
        ivec2 at = ivec2(pixel_in_tile(i));
        ivec3 edges = mine.edges + mine.a * at.x + mine.b * at.y;
        bool covers = mine.is_there && (edges.x | edges.y | edges.z) >= 0;
        uint covering = votes(covers);
        own = i == this_lane() ? covering : own;
        if (covers)
            depths[(base + i) * uint(LANES) + this_lane()] = fm_depth_bits(
                corner + at, mine.xy, mine.z, mine.dz_dx, mine.dz_dy, mine.z_least, mine.z_most);
    }
    subgroup_fence();
#if LANES > 1
    FM_LOOP do { // the test is last: see bin.glsl
        take_next(own, base, pixel);
        own &= own - 1u;
    } while (own != 0u);
#else
    take_next(own, base, pixel);
#endif
    iterations += LANES > 1 ? uint(bitCount(votes(mine.is_there))) + 1u : 0u; // at most
}
