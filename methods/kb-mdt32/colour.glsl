#include "kb-mdt32/key.glsl"
#include "kb-mdt32/put_colour.glsl"
#include "common/key_search.glsl"

// The colour goes beside the first slot with the fragment's key. Fragments of a pixel collide only if
// their keys are equal: then one of their colours stays, and with depth_bits=published the slots of
// the others keep colour 0.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth);
    if (key > key_at(pixel, K - 1u)) // most fragments, where k is small
        return;
    put_colour(pixel, slot_by_search(pixel, key), colour); // all keys up to the last slot's are there, for both
                                                           // passes rasterise by one vertex shader
}
