// Truth, first pass: how many fragments each pixel has.
void store(uvec2 pixel, float depth, uint colour)
{
    atomicAdd(counts[fm_pixel_index(pixel)], 1u); // fragments of a pixel may collide: any order is right
}
