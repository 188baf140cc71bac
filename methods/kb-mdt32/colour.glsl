#include "kb-mdt32/key.glsl"

// The colour goes beside the first slot with the fragment's key. Fragments of a pixel collide only if
// their keys are equal: then one of their colours stays, and with depth_bits=published the slots of
// the others keep colour 0.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth), first = 0u, end = K;
    FM_LOOP while (first < end) { // keys ascend: O(log k)
        uint middle = (first + end) / 2u;
        bool is_before = keys[array_slot(pixel, middle, K)] < key;
        first = is_before ? middle + 1u : first;
        end = is_before ? end : middle;
    }
    uint slot = array_slot(pixel, min(first, K - 1u), K);
    if (keys[slot] == key)
        colours[slot] = colour;
}
