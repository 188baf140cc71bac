#include "kb-mdt64/key.glsl"

// The multi depth test: each slot keeps the nearer of its fragment and the new one, and the farther
// one goes on to the next slot. Fragments of a pixel collide in atomicMin; each call leaves the
// smaller of two keys in the slot and hands the other to its caller, so none is lost or doubled. Slots
// only ever decrease, and what reaches slot i + 1 was not below slot i: they end ascending, and a last slot
// read too early rejects too little.
void store(uvec2 pixel, float depth, uint colour)
{
    uint64_t sinking = key_of(depth, colour);
    if (sinking >= keys[array_slot(pixel, K - 1u, K)])
        return;
    FM_LOOP for (uint i = 0u; i < K && sinking != EMPTY; ++i) {
        uint64_t found = atomicMin(keys[array_slot(pixel, i, K)], sinking);
        sinking = max(found, sinking);
    }
}
