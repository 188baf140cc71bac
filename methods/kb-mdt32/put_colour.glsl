// Colours lie beside the keys, slot by slot.
void put_colour(uvec2 pixel, uint i, uint colour)
{
    colours[array_slot(pixel, i, K)] = colour;
}
