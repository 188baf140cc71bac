#include "common/array.glsl"

// A max-heap in `count` slots from 0 on: the root is the farthest. Once it is full, the root is what a
// fragment must beat. Read without the lock: the count only grows and the root only comes nearer, so
// stale values cull too little, never too much; store() tests again.
bool wanted(uvec2 pixel, float depth)
{
    return counters[fm_pixel_index(pixel)] < K
        || fm_pack(depth, 0u).x < fragments[array_slot(pixel, 0u, K)].x;
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
        counters[i] = count + 1u;
        sift_up(pixel, count, fragment);
    } else if (fragment.x < fragments[array_slot(pixel, 0u, K)].x) {
        sift_down(pixel, fragment);
    }
}
