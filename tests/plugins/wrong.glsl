/* Hands over what was kept in other colours. */
void resolve(uvec2 pixel)
{
    const uvec2 slot = nearest[pixel.y * FM_WIDTH + pixel.x];
    if (slot.x != 0x7F800000u)
        fm_emit(pixel, 0, uintBitsToFloat(slot.x), slot.y ^ 0x00FF00FFu);
}
