#include "peer-spinlock/slot.glsl"

// Read without the lock: it only ever comes nearer, so a stale one culls too little.
bool wanted(uvec2 pixel, float depth)
{
    return fm_pack(depth, 0u).x < farthest[fm_pixel_index(pixel)];
}

// The first k in order of arrival; then the farthest of all is searched and replaced: O(k).
void store(uvec2 pixel, float depth, uint colour)
{
    uint at = fm_pixel_index(pixel), count = counters[at];
    uvec2 fragment = fm_pack(depth, colour);
    if (count < K) {
        fragments[slot_of(pixel, count)] = fragment;
        counters[at] = count + 1u;
    }
    if (count + 1u < K || fragment.x >= farthest[at])
        return;
    uint slot = 0u, most = 0u, next = 0u; // the farthest, and the one before it
    FM_LOOP for (uint i = 0u; i < K; ++i) {
        uint bits = fragments[slot_of(pixel, i)].x;
        slot = bits > most ? i : slot;
        next = max(next, min(most, bits));
        most = max(most, bits);
    }
    if (count == K)
        fragments[slot_of(pixel, slot)] = fragment;
    farthest[at] = count == K ? max(next, fragment.x) : most;
}
