#include "kb-mdt32/sink.glsl"
#include "common/key_search.glsl"

// The multi depth test. A last slot read too early rejects too little.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth);
    if (key < key_at(pixel, K - 1u))
        sink_from(pixel, chain_start(pixel, key), key);
}
