void resolve(uvec2 pixel)
{
    uvec2 fragment = nearest[fm_pixel_index(pixel)];
    if (fragment.x != FM_EMPTY_BITS)
        fm_emit(pixel, 0, uintBitsToFloat(fragment.x), fragment.y);
}
