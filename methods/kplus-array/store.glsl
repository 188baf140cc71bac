#include "common/array.glsl"

// Section 3.2, fragment culling: only what is nearer than the farthest kept one enters the section.
// Read without the lock: slot 0 only ever comes nearer, so a stale value culls too little, never
// too much; store() tests again.
bool wanted(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < fragments[array_slot(pixel, 0u, K)].x;
}

// The max-array: k-1 unsorted fragments, and in slot 0 the farthest of all k once they are there.
// Both ways to store end in one write, since software rasterisers run both sides of every branch.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    uint slot = K - 1u - count; // filled from the back: O(1)
    if (count + 1u >= K) { // O(k): the farthest of slots 1..k-1 or the new one goes to slot 0
        if (fragment.x >= fragments[array_slot(pixel, 0u, K)].x)
            return; // infinity before the array is full
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
    fragments[array_slot(pixel, slot, K)] = fragment;
    if (count < K)
        counters[i] = count + 1u;
}
