#include "ab-ll-paged/page.glsl"
#include "common/sort_limit.glsl"

// Where a pixel's pages are, for sorting in place: all of them, or every STRIDE-th if they are too many.
#if SORTS_IN_PLACE
const uint PAGES = (N + PAGE - 1u) / PAGE;
#if FM_RESUMES // no register is short, and each step of a stride would be counted
const uint TABLE = min(PAGES, 16384u);
#else
const uint TABLE = min(PAGES, 2u * SORT_PRIVATE_MAX); // the memory of SORT_PRIVATE_MAX records
#endif
const uint STRIDE = (PAGES + TABLE - 1u) / TABLE;
uint table[TABLE];
uint unused; // places of the last page, which is the first of the table

void find_pages(uvec2 pixel, uint count)
{
    uint link = heads[fm_pixel_index(pixel)], pages_used = (count + PAGE - 1u) / PAGE;
    unused = pages_used * PAGE - count;
    FM_LOOP for (uint i = 0u; i < pages_used; ++i) {
        if (i % STRIDE == 0u)
            table[i / STRIDE] = link;
        link = pages[link - 1u];
    }
}

// From the last fragment of the last page back to the first of the first.
uint place_of(uint i)
{
    uint back = i + unused, page = back / PAGE;
    uint link = table[page / STRIDE];
    if (STRIDE > 1u) { // software rasterisers count a loop that they enter for nothing, too
        FM_LOOP for (uint step = page % STRIDE; step > 0u; --step)
            link = pages[link - 1u];
    }
    return link + 2u * (PAGE - 1u - back % PAGE);
}
uvec2 fragment_at(uvec2 pixel, uint i)
{
    uint place = place_of(i);
    return uvec2(pages[place], pages[place + 1u]);
}
void put_fragment(uvec2 pixel, uint i, uvec2 fragment)
{
    uint place = place_of(i);
    pages[place] = fragment.x;
    pages[place + 1u] = fragment.y;
}
#define SORT_SPENT  (PAGES + 1u)
#define SORT_ACCESS (STRIDE > 1u ? STRIDE : 0u)
#include "common/sort_in_place.glsl"

void resolve(uvec2 pixel)
{
    uint count = min(counters[fm_pixel_index(pixel)], N);
    find_pages(pixel, count);
    emit_in_place(pixel, count);
}
#else
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
#endif
