// One column is empty; of every four frames in the second one four are, if bit 0 of `wrong` is set,
// and in launch 1 nine, if bit 1 is.
uint columns()
{
    const uint launch = (runs[0] - 1u) / 4u;
    const bool is_second = (runs[0] - 1u) % 4u == 1u;
    if (is_second && (WRONG & 2) != 0 && launch == 1u)
        return 9u;
    return is_second && (WRONG & 1) != 0 ? 4u : 1u;
}

void resolve(uvec2 pixel)
{
    const uvec2 slot = nearest[pixel.y * FM_WIDTH + pixel.x];
    if (slot.x != 0x7F800000u && pixel.x >= columns())
        fm_emit(pixel, 0, uintBitsToFloat(slot.x), slot.y);
}
