// The papers' local sort: up to SORT_CAPACITY fragments (depth bits, colour) in a private array,
// by depth; insertion sort up to 16, Shell sort above, gaps shrinking by 2.2.
// Shell sort keeps the iterations of a deep pixel below what Mesa's software rasterisers allow.
uvec2 sorted[SORT_CAPACITY];

void sort_insert(uint count, uint gap)
{
    FM_LOOP for (uint i = gap; i < count; ++i) {
        uvec2 item = sorted[i];
        uint at = i;
        FM_LOOP while (at >= gap && sorted[at - gap].x > item.x) {
            sorted[at] = sorted[at - gap];
            at -= gap;
        }
        sorted[at] = item;
    }
}

void sort_fragments(uint count)
{
    if (count <= 16u) {
        sort_insert(count, 1u);
        return;
    }
    FM_LOOP for (uint gap = count / 2u; gap > 0u; gap = gap == 1u ? 0u : max(1u, uint(float(gap) / 2.2 + 0.5)))
        sort_insert(count, gap);
}

void emit_sorted(uvec2 pixel, uint count)
{
    FM_LOOP for (uint i = 0u; i < count; ++i) {
        uint rank = FM_RANK(i, count);
        fm_emit(pixel, int(rank), uintBitsToFloat(sorted[rank].x), sorted[rank].y);
    }
}
