// Where a pixel's counter and its address lie, by the method's option per_pixel:
//   rows    in buffers, one row of pixels behind the other
//   tiles   in buffers, one tile of 8 x 8 pixels behind the other: those of a triangle lie near each other
//   images  in two images
// A method without the option has rows.
#if defined(PER_PIXEL_IMAGES) && PER_PIXEL == PER_PIXEL_IMAGES
#define count_of(pixel)             fm_load_counters(pixel).x
#define add_to_count(pixel)         imageAtomicAdd(fm_image_counters, ivec2(pixel), 1u)
#define address_of(pixel)           fm_load_addresses(pixel).x
#define set_address(pixel, address) fm_store_addresses(pixel, uvec4(address))
#define add_to_address(pixel)       imageAtomicAdd(fm_image_addresses, ivec2(pixel), 1u)
#else
#if defined(PER_PIXEL_TILES) && PER_PIXEL == PER_PIXEL_TILES
#include "common/tiles.glsl"
uint count_slot(uvec2 pixel)
{
    uvec3 place = tile_place(pixel);
    return place.x + place.z;
}
#else
#define count_slot fm_pixel_index
#endif
#define count_of(pixel)             counters[count_slot(pixel)]
#define add_to_count(pixel)         atomicAdd(counters[count_slot(pixel)], 1u)
#define address_of(pixel)           addresses[count_slot(pixel)]
#define set_address(pixel, address) addresses[count_slot(pixel)] = address
#define add_to_address(pixel)       atomicAdd(addresses[count_slot(pixel)], 1u)
#endif
