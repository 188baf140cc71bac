// Bounded: one beyond k tells that there are more than k. Fragments of a pixel collide; a stale count adds
// once more than it needs to, which tells the same.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    if (counters[i] <= K)
        atomicAdd(counters[i], 1u);
}
