/* Waits for what never comes: nothing of the buffer is 1 and none of it changes. */
void resolve(uvec2 pixel)
{
    const uint slot = pixel.y * FM_WIDTH + pixel.x;
    uint turns = 0u;
    while (nearest[slot].y != 1u || turns != 0xFFFFFFFFu)
        turns += 1u + (nearest[slot].y & 1u);
    fm_emit(pixel, 0, uintBitsToFloat(nearest[slot].x), turns);
}
