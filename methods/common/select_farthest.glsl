// As the k+-buffer paper selects the k nearest from an A-buffer: K-1 in any order and the farthest of all in the
// last slot; what is not nearer than that one is passed over.
#define SORT_CAPACITY K
#include "common/sort.glsl"

uint selected;

void select_none()
{
    selected = 0u;
}

void select_nearest(uvec2 fragment)
{
    if (selected + 1u < K) {
        sorted[selected++] = fragment;
        return;
    }
    if (selected == K && fragment.x >= sorted[K - 1u].x)
        return;
    uint farthest = K - 1u; // O(k): the new one takes the last slot, then the farthest does
    uvec2 last = fragment;
    FM_LOOP for (uint i = 0u; i + 1u < K; ++i) {
        bool is_farther = sorted[i].x > last.x;
        farthest = is_farther ? i : farthest;
        last = is_farther ? sorted[i] : last;
    }
    sorted[farthest] = fragment;
    sorted[K - 1u] = last;
    selected = K;
}

void emit_selected(uvec2 pixel)
{
    sort_fragments(selected);
    emit_sorted(pixel, selected);
}
