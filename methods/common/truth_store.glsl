// Truth, second pass: the fragments of a band of pixels, each pixel's side by side; sorted on the host.
void store(uvec2 pixel, float depth, uint colour)
{
    uint local = fm_pixel_index(pixel) - fm_band_first;
    if (local >= fm_band_pixels)
        return;
    uint i = atomicAdd(cursors[fm_pixel_index(pixel)], 1u); // unique; the order does not matter
    records[i] = uvec4(floatBitsToUint(depth), colour, fm_primitive, 0u);
}
