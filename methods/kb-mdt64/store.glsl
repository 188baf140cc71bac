#include "kb-mdt64/sink.glsl"
#include "common/key_search.glsl"

// The multi depth test: each slot keeps the nearer of its fragment and the new one, and the farther
// one goes on to the next slot. Slots only ever decrease, and what reaches slot i + 1 was not below slot i:
// they end ascending, and a last slot read too early rejects too little.
void store(uvec2 pixel, float depth, uint colour)
{
    uint64_t sinking = key_of(depth, colour);
    if (sinking >= key_at(pixel, K - 1u))
        return;
    FM_LOOP for (uint i = chain_start(pixel, sinking); i < K && sinking != EMPTY; ++i) {
        uint64_t found = sink_at(pixel, i, sinking);
        sinking = max(found, sinking);
    }
}
