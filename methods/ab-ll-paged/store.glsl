#include "ab-ll-paged/page.glsl"

bool wanted(uvec2 pixel, float depth)
{
    return true;
}

// A new page in front of those that are full.
uint take_page(uint full)
{
    uint page = atomicAdd(allocated[0], PAGE_WORDS); // pixels collide; each gets a page of its own
    if (page + PAGE_WORDS > fm_length_pages) {
        atomicAdd(allocated[1], PAGE_WORDS); // the pool grows by that many, and the frame runs again
        return NO_ROOM;
    }
    pages[page] = full;
    return page + 1u;
}

// Every fourth fragment of a pixel takes a page. The lock is there for head and counter.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i], head = heads[i];
    if (count % PAGE == 0u) {
        head = take_page(head);
        heads[i] = head;
    }
    counters[i] = count + 1u;
    if (head == NO_ROOM)
        return;
    uvec2 fragment = fm_pack(depth, colour);
    pages[head + 2u * (count % PAGE)] = fragment.x;
    pages[head + 2u * (count % PAGE) + 1u] = fragment.y;
}
