#include "s-buffer/place.glsl"
#define SORT_CAPACITY N
#include "common/sort.glsl"

// The store left the address behind the pixel's last fragment.
void resolve(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint count = min(counters[i], N), end = count > 0u ? addresses[i] : 0u;
    FM_LOOP for (uint back = 0u; back < count; ++back)
        sorted[back] = fragments[bin_place(pixel, end - 1u - back)];
    sort_fragments(count);
    emit_sorted(pixel, count);
}
