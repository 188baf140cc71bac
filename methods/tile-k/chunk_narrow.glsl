// A chunk of triangles against a block of as many pixels, where reading memory is what costs: lane =
// triangle computes the depths at all pixels of the block, and lane = pixel reads those of its own
// triangles.
shared uint depths[FM_GROUP_LANES * LANES]; // [subgroup][pixel][triangle]
shared uint numbers[FM_GROUP_LANES];

void scan_chunk(lane_triangle mine, uvec2 pixel, ivec2 corner)
{
    uint base = this_place() - this_lane(), own = 0u;
    subgroup_fence(); // the last chunk's have been read
    numbers[this_place()] = mine.number;
    for (uint i = 0u; i < uint(LANES); ++i) {
        ivec2 at = ivec2(pixel_in_tile(i));
        ivec3 edges = mine.edges + mine.a * at.x + mine.b * at.y;
        uint covering = votes(mine.is_there && (edges.x | edges.y | edges.z) >= 0);
        own = i == this_lane() ? covering : own;
        depths[(base + i) * uint(LANES) + this_lane()] = fm_depth_bits(
            corner + at, mine.xy, mine.z, mine.dz_dx, mine.dz_dy, mine.z_least, mine.z_most);
    }
    subgroup_fence();
    FM_LOOP while (own != 0u) { // bit j: triangle j covers this lane's pixel
        uint lane = uint(findLSB(own));
        own &= own - 1u;
        uint number = numbers[base + lane];
        if (fm_triangle_lives(number, pixel))
            take(uvec2(number, depths[this_place() * uint(LANES) + lane]));
    }
    iterations += uint(LANES) + 1u; // at most
}
