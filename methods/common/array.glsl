// Where element i of a pixel's array of `length` lies: the method's option layout decides.
//   pixel  a pixel's elements side by side
//   layer  the i-th elements of all pixels side by side
//   tile   as layer, within tiles of 8 x 8 pixels (narrower at the border: no element is wasted)
//   image  on layer i of an image that stands in for the buffer (when_option in fragmark/resource.h):
//          shaders ask ARRAY_IS_IMAGE, and call fm_load_NAME and fm_store_NAME then
// A method with places of its own defines OWN_ARRAY_SLOT and array_slot() before it includes this.
#if defined(LAYOUT_IMAGE) && LAYOUT == LAYOUT_IMAGE
#define ARRAY_IS_IMAGE 1
#else
#define ARRAY_IS_IMAGE 0
#endif
#ifndef OWN_ARRAY_SLOT
#include "common/tiles.glsl"
uint array_slot(uvec2 pixel, uint i, uint length)
{
#if LAYOUT == LAYOUT_LAYER
    return i * uint(FM_PIXELS) + fm_pixel_index(pixel);
#elif defined(LAYOUT_TILE) && LAYOUT == LAYOUT_TILE
    uvec3 place = tile_place(pixel);
    return place.x * length + i * place.y + place.z;
#else
    return fm_pixel_index(pixel) * length + i;
#endif
}
#endif
