// Least and greatest depth of a pixel. Fragments of a pixel collide: the greatest, of the bits and of their
// complements, is the same in any order of arrival. Bits of depths >= 0 compare as the depths do.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = 2u * fm_pixel_index(pixel), bits = fm_pack(depth, 0u).x;
    atomicMax(fm_cull_range[i], ~bits);
    atomicMax(fm_cull_range[i + 1u], bits);
}
