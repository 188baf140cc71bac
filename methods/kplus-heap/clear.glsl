void clear(uvec2 pixel)
{
    counters[fm_pixel_index(pixel)] = 0u;
}
