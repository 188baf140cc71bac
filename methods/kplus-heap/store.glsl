#include "common/array.glsl"

// A max-heap in `count` slots from 0 on: the root is the farthest. Once it is full, the root is what a
// fragment must beat. Read without the lock: a full heap's root only comes nearer, so a stale one culls
// too little, never too much; store() tests again. The root is not the farthest before the heap is
// full, hence the fences: whoever reads a full count reads a root of that time or later.
bool wanted(uvec2 pixel, float depth)
{
    uint count = counters[fm_pixel_index(pixel)];
    fm_fence();
    return count < K || fm_pack(depth, 0u).x < fragments[array_slot(pixel, 0u, K)].x;
}

void sift_up(uvec2 pixel, uint at, uvec2 fragment)
{
    FM_LOOP while (at > 0u) {
        uint parent = (at - 1u) / 2u;
        uvec2 item = fragments[array_slot(pixel, parent, K)];
        if (item.x >= fragment.x)
            break;
        fragments[array_slot(pixel, at, K)] = item;
        at = parent;
    }
    fragments[array_slot(pixel, at, K)] = fragment;
}

void sift_down(uvec2 pixel, uvec2 fragment)
{
    uint at = 0u, child = 1u;
    FM_LOOP while (child < K) {
        uvec2 item = fragments[array_slot(pixel, child, K)];
        if (child + 1u < K) { // the last level may be short
            uvec2 sibling = fragments[array_slot(pixel, child + 1u, K)];
            if (sibling.x > item.x) {
                item = sibling;
                ++child;
            }
        }
        if (item.x <= fragment.x)
            break;
        fragments[array_slot(pixel, at, K)] = item;
        at = child;
        child = 2u * at + 1u;
    }
    fragments[array_slot(pixel, at, K)] = fragment;
}

void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    if (count < K) { // O(log k) for each, as the paper builds it
        sift_up(pixel, count, fragment);
        if (count + 1u == K)
            fm_fence();
        counters[i] = count + 1u;
    } else if (fragment.x < fragments[array_slot(pixel, 0u, K)].x) {
        sift_down(pixel, fragment);
    }
}
