// Slots of keys that a pass writes.
#include "kb-mdt32/key.glsl"

void put_key(uvec2 pixel, uint i, uint key)
{
#if ARRAY_IS_IMAGE
    fm_store_keys(pixel, i, uvec4(key, 0u, 0u, 0u));
#else
    keys[array_slot(pixel, i, K)] = key;
#endif
}

// Fragments of a pixel collide here: each call leaves the smaller of two keys and hands the other to its
// caller, so none is lost.
uint sink_at(uvec2 pixel, uint i, uint key)
{
#if ARRAY_IS_IMAGE
    return imageAtomicMin(fm_image_keys, ivec3(pixel, i), key);
#else
    return atomicMin(keys[array_slot(pixel, i, K)], key);
#endif
}

// The chain from slot i on: each slot keeps the nearer of its key and the new one, and the farther one
// goes on to the next slot. Slots only ever decrease, and they end ascending.
void sink_from(uvec2 pixel, uint i, uint sinking)
{
    bool is_done = false;
    FM_LOOP for (; i < K && !is_done; ++i) {
        uint found = sink_at(pixel, i, sinking);
        is_done = found == EMPTY || (EQUAL_DEPTHS_MERGE != 0 && found == sinking);
        sinking = max(found, sinking);
    }
}
