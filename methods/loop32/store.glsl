#include "kb-mdt32/sink.glsl"
#include "common/key_search.glsl"

// First pass over the scene: a chain of atomicMin on depths that begins at k/2 if the fragment is behind that
// slot's. A last slot read too early rejects too little.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth);
    if (key <= key_at(pixel, K - 1u))
        sink_from(pixel, slot_by_half(pixel, key), key);
}
