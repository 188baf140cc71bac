// Slots of keys that a pass writes.
#include "kb-mdt64/key.glsl"

void put_key(uvec2 pixel, uint i, uint64_t key)
{
    keys[array_slot(pixel, i, K)] = key;
}

// Fragments of a pixel collide here: each call leaves the smaller of two keys and hands the other to its
// caller, so none is lost or doubled.
uint64_t sink_at(uvec2 pixel, uint i, uint64_t key)
{
    return atomicMin(keys[array_slot(pixel, i, K)], key);
}
