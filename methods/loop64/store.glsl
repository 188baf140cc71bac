#include "kb-mdt64/sink.glsl"
#include "common/key_search.glsl"

// A chain of atomicMin that begins at k/2 if the fragment is behind that slot's. A last slot read too early
// rejects too little.
void store(uvec2 pixel, float depth, uint colour)
{
    uint64_t sinking = key_of(depth, colour);
    if (sinking > key_at(pixel, K - 1u))
        return;
    FM_LOOP for (uint i = slot_by_half(pixel, sinking); i < K && sinking != EMPTY; ++i) {
        uint64_t found = sink_at(pixel, i, sinking);
        sinking = max(found, sinking);
    }
}
