// Each pixel takes its stretch of the list; where it lies does not matter.
void reference(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    if (count > 0u)
        offsets[i] = atomicAdd(allocated[0], count); // pixels collide; each gets its own stretch
    counters[i] = 0u;
}
