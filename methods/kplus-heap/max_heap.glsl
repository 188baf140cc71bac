// A max-heap in `count` slots from 0 on: the root is the farthest.

// Is it nearer than the farthest of a full heap? Read without the lock: a full heap's root only comes
// nearer, so a stale one culls too little, never too much; place() tests again. The root is not the
// farthest before the heap is full, hence the fences, here and where the count becomes full: whoever
// reads a full count reads a root of that time or later.
bool beats_farthest(uvec2 pixel, float depth)
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
        uvec2 item = fragments[array_slot(pixel, child, K)];
        uvec2 other = fragments[array_slot(pixel, sibling, K)];
        if (other.x > item.x) {
            item = other;
            child = sibling;
        }
        if (item.x <= bits)
            break;
        fragments[array_slot(pixel, at, K)] = item;
        at = child;
        child = 2u * at + 1u;
    }
    return at;
}

// The slot for a fragment that comes to `count` others, O(log k) for each, as the paper builds it; K: it
// is not wanted.
uint place(uvec2 pixel, uint count, uvec2 fragment)
{
    uint at = uint(K);
    if (count < K)
        at = sift_up(pixel, count, fragment.x);
    else if (fragment.x < fragments[array_slot(pixel, 0u, K)].x)
        at = sift_down(pixel, fragment.x);
    return at;
}
