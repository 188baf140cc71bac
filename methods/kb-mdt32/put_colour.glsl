// Colours lie beside the keys, slot by slot.
void put_colour(uvec2 pixel, uint i, uint colour)
{
#if ARRAY_IS_IMAGE
    fm_store_colours(pixel, i, uvec4(colour, 0u, 0u, 0u));
#else
    colours[array_slot(pixel, i, K)] = colour;
#endif
}
