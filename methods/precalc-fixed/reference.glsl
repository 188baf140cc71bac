// Memory referencing: arrays of N, one after the other.
void reference(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    addresses[i] = i * N;
    counters[i] = 0u;
}
