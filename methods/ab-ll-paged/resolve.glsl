#include "ab-ll-paged/page.glsl"
#define SORT_CAPACITY N
#include "common/sort.glsl"

// From the last fragment of the last page back to the first of the first.
void resolve(uvec2 pixel)
{
    uint i = fm_pixel_index(pixel);
    uint page = heads[i], count = min(counters[i], N);
    FM_LOOP for (uint back = 0u; back < count; ++back) {
        uint place = (count - 1u - back) % PAGE;
        sorted[back] = uvec2(pages[page + 2u * place], pages[page + 2u * place + 1u]);
        if (place == 0u)
            page = pages[page - 1u];
    }
    sort_fragments(count);
    emit_sorted(pixel, count);
}
