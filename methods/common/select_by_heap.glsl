// The k nearest so far as a heap with the farthest at its root, whose place the next nearer one takes: O(log k). At first
// all are at infinity. What is not nearer than the root costs one comparison.
#define SLOTS (K < N ? uint(K) : uint(N))
#define SORT_CAPACITY (K < N ? K : N)
#include "common/sort.glsl"

void select_none()
{
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i)
        sorted[i] = uvec2(FM_EMPTY_BITS, 0u);
}

void select_nearest(uvec2 fragment)
{
    if (fragment.x >= sorted[0].x)
        return;
    uint root = 0u, child = min(1u, SLOTS - 1u);
    FM_LOOP while (child > root) {
        uint other = min(child + 1u, SLOTS - 1u);
        child = sorted[other].x > sorted[child].x ? other : child;
        uvec2 below = sorted[child];
        if (below.x <= fragment.x)
            break;
        sorted[root] = below;
        root = child;
        child = 2u * root + 1u < SLOTS ? 2u * root + 1u : root;
    }
    sorted[root] = fragment;
}

// Where there were fewer than K, what is at infinity goes before it is sorted.
void emit_selected(uvec2 pixel)
{
    uint selected = 0u;
    FM_LOOP for (uint i = 0u; i < SLOTS; ++i) {
        uvec2 fragment = sorted[i];
        sorted[selected] = fragment;
        selected += fragment.x != FM_EMPTY_BITS ? 1u : 0u;
    }
    sort_fragments(selected);
    emit_sorted(pixel, selected);
}
