// The farthest kept depth is infinity until k fragments are there.
void clear(uvec2 pixel)
{
    counters[fm_pixel_index(pixel)] = 0u;
    farthest[fm_pixel_index(pixel)] = FM_EMPTY_BITS;
}
