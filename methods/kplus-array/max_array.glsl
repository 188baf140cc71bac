// The max-array: k-1 unsorted fragments, and in slot 0 the farthest of all k once they are there. Before,
// slot 0 is at infinity.

// Is it nearer than the farthest kept one? Read without the lock: slot 0 only ever comes nearer, so a
// stale value culls too little, never too much; place() tests again.
bool beats_farthest(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < fragments[array_slot(pixel, 0u, K)].x;
}

// The slot for a fragment that comes to `count` others; K: it is not wanted.
uint place(uvec2 pixel, uint count, uvec2 fragment)
{
    uint slot = K - 1u - count; // filled from the back: O(1)
    if (count + 1u >= K) { // O(k): the farthest of slots 1..k-1 or the new one goes to slot 0
        slot = uint(K);
        if (fragment.x < fragments[array_slot(pixel, 0u, K)].x) { // infinity before it is full
            uint farthest_bits = fragment.x;
            slot = 0u;
            FM_LOOP for (uint other = 1u; other < K; ++other) {
                uint bits = fragments[array_slot(pixel, other, K)].x;
                slot = bits > farthest_bits ? other : slot;
                farthest_bits = max(bits, farthest_bits);
            }
            if (slot > 0u)
                fragments[array_slot(pixel, 0u, K)] =
                    uvec2(farthest_bits, fragments[array_slot(pixel, slot, K)].y);
        }
    }
    return slot;
}
