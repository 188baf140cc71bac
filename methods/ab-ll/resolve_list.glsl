// A list's fragments in order: copied to a private array and sorted there, as published, or, where that
// array would be too long, the list itself is sorted; in runs of the pass where the device would end its
// loops. A list is its head's alone.
#include "ab-ll/nodes.glsl"

#define OWN_CURSORS
uvec2 fragment_at(uvec2 pixel, uint link)
{
    return fragment_of(link);
}
void put_fragment(uvec2 pixel, uint link, uvec2 fragment)
{
    set_fragment(link, fragment);
}
uint next_cursor(uint link)
{
    return next_of(link);
}
#include "common/sort_limit.glsl"
#if FM_RESUMES && (defined(LISTS) || N > FM_LOOP_LIMIT / 20) // before, one merge sort is within the limit
#include "ab-ll/sort_links_in_runs.glsl"
#elif SORTS_BY_NETWORK

uint resolve_list(uvec2 pixel, uint list, uint rank)
{
    return emit_by_network(pixel, heads[list], END_OF_LIST, rank, 0u);
}
#elif SORTS_IN_PLACE
#include "ab-ll/sort_links.glsl"

// Emits from `rank` on; the rank behind the last.
uint resolve_list(uvec2 pixel, uint list, uint rank)
{
    uint link = sort_links(heads[list]);
    heads[list] = link; // another band of the check walks the list again
    FM_LOOP while (link != END_OF_LIST) {
        uvec3 node = node_at(link);
        emit_node(pixel, node, rank++);
        link = node.z;
    }
    return rank;
}
#else
#define SORT_CAPACITY N
#include "common/sort.glsl"

uint resolve_list(uvec2 pixel, uint list, uint rank)
{
    uint link = heads[list];
    uint count = 0u;
    FM_LOOP while (link != END_OF_LIST && count < N) {
        uvec3 node = node_at(link);
        sorted[count++] = node.xy;
        link = node.z;
    }
    sort_fragments(count);
    FM_LOOP for (uint i = 0u; i < count; ++i)
        fm_emit(pixel, int(rank++), uintBitsToFloat(sorted[i].x), sorted[i].y);
    return rank;
}
#endif
