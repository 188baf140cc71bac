#include "kb-mdt32/key.glsl"

// The colour goes beside the first slot with the fragment's key. Fragments of a pixel collide only if
// their keys are equal: then one of their colours stays, and with depth_bits=published the slots of
// the others keep colour 0.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth), first = 0u, end = K;
    FM_LOOP while (first < end) { // keys ascend: O(log k)
        uint middle = (first + end) / 2u;
        bool is_before = key_at(pixel, middle) < key;
        first = is_before ? middle + 1u : first;
        end = is_before ? end : middle;
    }
    uint i = min(first, K - 1u);
    if (key_at(pixel, i) == key)
        put_colour(pixel, i, colour);
}
