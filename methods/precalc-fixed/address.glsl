// A pixel's array begins at the address that the pass `reference` wrote down.
#define OWN_ARRAY_SLOT
uint array_slot(uvec2 pixel, uint i, uint length)
{
    return addresses[fm_pixel_index(pixel)] + i;
}
