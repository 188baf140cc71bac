// A pixel's min(f, k) records lie side by side from its address on; the highest bit of the address tells
// that there are more than k fragments, so that the farthest must be found.
#define OWN_ARRAY_SLOT
const uint IS_DEEP = 0x80000000u;

bool is_deep(uvec2 pixel)
{
    return (addresses[fm_pixel_index(pixel)] & IS_DEEP) != 0u;
}

uint array_slot(uvec2 pixel, uint i, uint length)
{
    return (addresses[fm_pixel_index(pixel)] & ~IS_DEEP) + i;
}
