// The max-array: k-1 unsorted fragments, and in slot 0 the farthest of all k once they are there. Before,
// slot 0 is at infinity. Slots are filled from the last. A method whose fragments have another order than that of
// their depths defines it before it includes this.
#ifndef IS_FARTHER
#define IS_FARTHER(one, other) ((one).x > (other).x)
#endif

// The slot for a fragment that comes to `count` others, or is nearer than slot 0. Where all K are there then,
// `farthest_bits` is the depth of slot 0.
uint place(uvec2 pixel, uint count, uvec2 fragment, inout uint farthest_bits)
{
    uint slot = K - 1u - min(count, K - 1u); // O(1)
    if (slot == 0u) { // O(k): the farthest of slots 1..k-1 or the new one goes to slot 0
        uvec2 farthest = fragment;
        FM_LOOP for (uint other = 1u; other < K; ++other) {
            uvec2 item = kept_at(pixel, other);
            bool is_farthest = IS_FARTHER(item, farthest);
            slot = is_farthest ? other : slot;
            farthest = is_farthest ? item : farthest;
        }
        if (slot > 0u)
            keep_at(pixel, 0u, farthest);
        farthest_bits = farthest.x;
    }
    return slot;
}
