uint slot_of(uvec2 pixel, uint i)
{
    return i * uint(FM_PIXELS) + fm_pixel_index(pixel);
}
