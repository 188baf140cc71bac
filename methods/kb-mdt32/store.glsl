#include "kb-mdt32/key.glsl"

// The multi depth test: each slot keeps the nearer of its key and the new one, and the farther one
// goes on to the next slot. Fragments of a pixel collide in atomicMin; each call leaves the smaller of
// two keys in the slot and hands the other to its caller, so none is lost. Slots only ever decrease:
// a last slot read too early rejects too little, and they end ascending.
void store(uvec2 pixel, float depth, uint colour)
{
    uint sinking = key_of(depth);
    bool is_done = sinking >= key_at(pixel, K - 1u);
    FM_LOOP for (uint i = 0u; i < K && !is_done; ++i) {
        uint found = keep_nearer(pixel, i, sinking);
        is_done = found == EMPTY;
#if DEPTH_BITS == DEPTH_BITS_EXACT
        is_done = is_done || found == sinking; // of equal depths one is kept
#endif
        sinking = max(found, sinking);
    }
}
