// Fragments of a pixel collide: smallest and largest are the same in any order of arrival.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = 2u * fm_pixel_index(pixel), bits = fm_pack(depth, colour).x;
    atomicMin(bounds[i], bits);
    atomicMax(bounds[i + 1u], bits);
}
