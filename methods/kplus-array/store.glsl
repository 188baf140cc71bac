#include "common/array.glsl"

// Section 3.2, fragment culling: only what is nearer than the farthest kept one enters the section.
// Read without the lock: slot 0 only ever comes nearer, so a stale value culls too little, never
// too much; store() tests again.
bool wanted(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < fragments[array_slot(pixel, 0u, K)].x;
}

// The max-array: k-1 unsorted fragments, and in slot 0 the farthest of all k once they are there.
void store(uvec2 pixel, float depth, uint colour)
{
    uint i = fm_pixel_index(pixel);
    uint count = counters[i];
    uvec2 fragment = fm_pack(depth, colour);
    if (count + 1u < K) { // filled from the back: O(1)
        fragments[array_slot(pixel, K - 1u - count, K)] = fragment;
        counters[i] = count + 1u;
        return;
    }
    if (count == K && fragment.x >= fragments[array_slot(pixel, 0u, K)].x)
        return;
    counters[i] = K;
    uint farthest = 0u;
    uint farthest_bits = fragment.x;
    FM_LOOP for (uint slot = 1u; slot < K; ++slot) { // O(k): who is the farthest now
        uint bits = fragments[array_slot(pixel, slot, K)].x;
        if (bits > farthest_bits) {
            farthest = slot;
            farthest_bits = bits;
        }
    }
    if (farthest > 0u)
        fragments[array_slot(pixel, 0u, K)] = fragments[array_slot(pixel, farthest, K)];
    fragments[array_slot(pixel, farthest, K)] = fragment;
}
