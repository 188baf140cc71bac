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

// Where a fragment goes that is appended behind `count` others: ancestors that are nearer move down.
uint sift_up(uvec2 pixel, uint at, uint bits)
{
    FM_LOOP while (at > 0u) {
        uint parent = (at - 1u) / 2u;
        uint parent_bits = fragments[array_slot(pixel, parent, K)].x;
        if (parent_bits >= bits)
            break;
        fragments[array_slot(pixel, at, K)] =
            uvec2(parent_bits, fragments[array_slot(pixel, parent, K)].y);
        at = parent;
    }
    return at;
}

// Where a fragment goes that takes the root's place: the farther child moves up.
uint sift_down(uvec2 pixel, uint bits)
{
    uint at = 0u, child = 1u;
    FM_LOOP while (child < K) {
        uint sibling = min(child + 1u, K - 1u); // the last level may be short
        uint child_bits = fragments[array_slot(pixel, child, K)].x;
        uint sibling_bits = fragments[array_slot(pixel, sibling, K)].x;
        child = sibling_bits > child_bits ? sibling : child;
        child_bits = max(child_bits, sibling_bits);
        if (child_bits <= bits)
            break;
        fragments[array_slot(pixel, at, K)] =
            uvec2(child_bits, fragments[array_slot(pixel, child, K)].y);
        at = child;
        child = 2u * at + 1u;
    }
    return at;
}

// Both ways to store end in one write, since software rasterisers run both sides of every branch.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    uint at;
    if (count < K) // O(log k) for each, as the paper builds it
        at = sift_up(pixel, count, fragment.x);
    else if (fragment.x < fragments[array_slot(pixel, 0u, K)].x)
        at = sift_down(pixel, fragment.x);
    else
        return;
    fragments[array_slot(pixel, at, K)] = fragment;
    if (count + 1u == K)
        fm_fence();
    if (count < K)
        counters[i] = count + 1u;
}
