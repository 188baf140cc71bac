#include "kb-mdt32/key.glsl"
#include "kb-mdt32/put_colour.glsl"
#include "common/key_search.glsl"

// Second pass over the scene: the slot with the fragment's depth gets its colour. Fragments of a pixel collide
// only if their depths are equal: then one of their colours stays.
void store(uvec2 pixel, float depth, uint colour)
{
    uint key = key_of(depth);
    if (key > key_at(pixel, K - 1u))
        return;
    bool is_done = false;
    FM_LOOP for (uint i = slot_by_half(pixel, key); i < K && !is_done; ++i) {
        is_done = key_at(pixel, i) == key;
        if (is_done)
            put_colour(pixel, i, colour);
    }
}
