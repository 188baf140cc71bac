// Where element i of a pixel's array of `length` lies: the method's option layout decides.
//   pixel  a pixel's elements side by side
//   layer  the i-th elements of all pixels side by side
// A method with places of its own defines OWN_ARRAY_SLOT and array_slot() before it includes this.
#ifndef OWN_ARRAY_SLOT
uint array_slot(uvec2 pixel, uint i, uint length)
{
#if LAYOUT == LAYOUT_LAYER
    return i * uint(FM_PIXELS) + fm_pixel_index(pixel);
#else
    return fm_pixel_index(pixel) * length + i;
#endif
}
#endif
