/* Under the lock: the pixel's one slot keeps the nearest. */
bool wanted(uvec2 pixel, float depth)
{
    return floatBitsToUint(depth) < nearest[pixel.y * FM_WIDTH + pixel.x].x;
}

void store(uvec2 pixel, float depth, uint colour)
{
    const uint slot = pixel.y * FM_WIDTH + pixel.x;
    if (floatBitsToUint(depth) < nearest[slot].x)
        nearest[slot] = uvec2(floatBitsToUint(depth), colour);
}
