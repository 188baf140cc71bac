// Where a pixel's words of the map lie: the same words of neighbours side by side.
uint cull_word(uvec2 pixel, uint word)
{
    return word * uint(FM_PIXELS) + fm_pixel_index(pixel);
}
