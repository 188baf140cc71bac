// A chunk of triangles against a block of as many pixels. Lane = triangle finds which pixels it covers;
// ballots turn that into a word for each pixel; then each lane = pixel walks its own triangles only, and
// no lane waits while others insert what it does not have.

// Of the triangles that a subgroup has in hand: xy, z, number; dz_dx, dz_dy, least, most.
shared ivec4 planes[2 * FM_GROUP_LANES];

void share_planes(lane_triangle mine)
{
    uint at = 2u * this_place();
    subgroup_fence(); // the last chunk's have been read
    planes[at] = ivec4(floatBitsToInt(mine.xy), floatBitsToInt(mine.z), int(mine.number));
    planes[at + 1u] = floatBitsToInt(vec4(mine.dz_dx, mine.dz_dy, mine.z_least, mine.z_most));
    subgroup_fence();
}

// Bit j: triangle j of the chunk covers this lane's pixel.
uint find_own(lane_triangle mine)
{
    uint own = 0u;
    for (uint i = 0u; i < uint(LANES); ++i) {
        ivec2 at = ivec2(pixel_in_tile(i));
        ivec3 edges = mine.edges + mine.a * at.x + mine.b * at.y;
        uint covering = votes(mine.is_there && (edges.x | edges.y | edges.z) >= 0);
        own = i == this_lane() ? covering : own;
    }
    return own;
}

void scan_chunk(lane_triangle mine, uvec2 pixel, ivec2 corner)
{
    share_planes(mine);
    uint own = find_own(mine), base = 2u * (this_place() - this_lane());
    FM_LOOP while (own != 0u) {
        uint at = base + 2u * uint(findLSB(own));
        own &= own - 1u;
        vec4 slope = intBitsToFloat(planes[at + 1u]);
        uint number = uint(planes[at].w);
        uint depth = fm_depth_bits(ivec2(pixel), intBitsToFloat(planes[at].xy),
                                   intBitsToFloat(planes[at].z), slope.x, slope.y, slope.z, slope.w);
        if (fm_triangle_lives(number, pixel))
            take(uvec2(number, depth));
    }
}
