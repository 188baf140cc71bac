// Outside the lock: another fragment may store a nearer one meanwhile, so store() asks again.
bool wanted(uvec2 pixel, float depth)
{
    return floatBitsToUint(abs(depth)) < nearest[fm_pixel_index(pixel)].x;
}

void store(uvec2 pixel, float depth, uint colour)
{
    if (wanted(pixel, depth))
        nearest[fm_pixel_index(pixel)] = fm_pack(depth, colour);
}
