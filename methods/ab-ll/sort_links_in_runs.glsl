// Radix sort of a list by its links, in runs of a pass (FM_RESUMES): a bit of the depth after the other, from
// the lowest. A bit deals the nodes to two lists in the order they come, and joins them. Between runs
// nothing but the list has to be kept. Nodes as in nodes.glsl, which is included before.
//
// Loops take sixteen nodes a turn: the device counts turns.
#define FOUR_TIMES(x)    x x x x
#define SIXTEEN_TIMES(x) FOUR_TIMES(FOUR_TIMES(x))

#ifndef LISTS // of a pixel
#define LISTS 1u
#endif
#ifndef LIST_MOST // fragments that are handed over
#define LIST_MOST N
#endif

const uint DEPTH_BITS = 30u; // depths reach from 0 to 1, 0x3F800000
const uint LIST_TURNS = uint(N) / 16u + 3u;
const uint BITS_OF_RUN = max(uint(FM_RUN_ITERATIONS) / (LISTS * LIST_TURNS), 1u);

uvec2 first_dealt, last_dealt; // with a 0 and with a 1

// The node goes behind its list; returns the one that came after it.
uint deal_node(uint link, uint bit)
{
    uvec3 node = node_at(link);
    bool is_one = (node.x >> bit & 1u) != 0u;
    uint last = is_one ? last_dealt.y : last_dealt.x, next = node.z;
    if (last != END_OF_LIST)
        set_next(last, link);
    else
        first_dealt = is_one ? uvec2(first_dealt.x, link) : uvec2(link, first_dealt.y);
    last_dealt = is_one ? uvec2(last_dealt.x, link) : uvec2(link, last_dealt.y);
    return next;
}

uint deal_list(uint link, uint bit)
{
    first_dealt = uvec2(END_OF_LIST);
    last_dealt = uvec2(END_OF_LIST);
    FM_LOOP while (link != END_OF_LIST) {
        SIXTEEN_TIMES(if (link != END_OF_LIST) link = deal_node(link, bit);)
    }
    if (last_dealt.y != END_OF_LIST)
        set_next(last_dealt.y, END_OF_LIST);
    if (last_dealt.x != END_OF_LIST)
        set_next(last_dealt.x, first_dealt.y);
    return last_dealt.x != END_OF_LIST ? first_dealt.x : first_dealt.y;
}

uint emit_and_next(uvec2 pixel, uint link, uint rank)
{
    uvec3 node = node_at(link);
    emit_node(pixel, node, rank);
    return node.z;
}

// The runs sort, and the last one emits, from `rank` on; the rank behind the last.
uint resolve_list(uvec2 pixel, uint list, uint rank)
{
    uint link = heads[list], bit = fm_run * BITS_OF_RUN;
    if (bit < DEPTH_BITS) {
        FM_LOOP for (uint end = min(bit + BITS_OF_RUN, DEPTH_BITS); bit < end; ++bit)
            link = deal_list(link, bit);
        heads[list] = link;
        if (link != END_OF_LIST)
            fm_go_on();
        return rank;
    }
    FM_LOOP while (link != END_OF_LIST && rank < uint(LIST_MOST)) {
        SIXTEEN_TIMES(if (link != END_OF_LIST && rank < uint(LIST_MOST))
                          link = emit_and_next(pixel, link, rank++);)
    }
    return rank;
}
