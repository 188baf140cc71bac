// Merge sort of a list by its links: any number of nodes, no memory but theirs, n log n in any order.
// An invocation has its lists for itself. Nodes as in nodes.glsl, which is included before.

// Two sorted lists as one. Who comes before whom if depths are equal: the older list's.
uint merge_links(uint older, uint newer)
{
    uint first = END_OF_LIST, last = END_OF_LIST;
    FM_LOOP while (older != END_OF_LIST && newer != END_OF_LIST) {
        bool takes_older = depth_bits_of(older) <= depth_bits_of(newer);
        uint taken = takes_older ? older : newer;
        if (first == END_OF_LIST)
            first = taken;
        else
            set_next(last, taken);
        last = taken;
        older = takes_older ? next_of(older) : older;
        newer = takes_older ? newer : next_of(newer);
    }
    uint rest = older != END_OF_LIST ? older : newer;
    if (first == END_OF_LIST)
        return rest;
    set_next(last, rest);
    return first;
}

// Counts nodes in binary: pending[i] is a sorted list of 2^i nodes where bit i is set, and adding a node
// carries. The pool's words are counted in 32 bits, so 32 lists are enough for all.
uint sort_links(uint link)
{
    uint pending[32];
    uint count = 0u;
    FM_LOOP while (link != END_OF_LIST) {
        uint merged = link, bit = 0u;
        link = next_of(link);
        set_next(merged, END_OF_LIST);
        FM_LOOP for (; (count >> bit & 1u) != 0u; ++bit)
            merged = merge_links(pending[bit], merged);
        pending[bit] = merged;
        ++count;
    }
    uint sorted_link = END_OF_LIST;
    FM_LOOP for (uint bit = 0u; count >> bit != 0u; ++bit)
        if ((count >> bit & 1u) != 0u)
            sorted_link = merge_links(pending[bit], sorted_link);
    return sorted_link;
}
