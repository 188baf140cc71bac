// Ends a pass: the boundary moves on, and where all places were taken there may be more to come.
void advance(uvec2 pixel, uint farthest_bits, uint slots)
{
    boundary[fm_pixel_index(pixel)] = farthest_bits;
    if (farthest_bits != FM_EMPTY_BITS && (fm_iteration + 1u) * slots < K)
        left[0] = 1u; // all write the same
}
