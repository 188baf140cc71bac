// A depth as an integer that compares as the depth does.
//   exact      the float's bits
//   published  uint((z - near) / far * (2^32 - 1)) in float arithmetic, as the k+-buffer paper's code: the
//              division merges some neighbouring floats, and what lies before `near` becomes 0
#include "common/array.glsl"

const uint EMPTY = 0xFFFFFFFFu;

uint key_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_keys(pixel, i).x;
#else
    return keys[array_slot(pixel, i, K)];
#endif
}

#ifdef FM_WRITES_KEYS
void put_key(uvec2 pixel, uint i, uint key)
{
#if ARRAY_IS_IMAGE
    fm_store_keys(pixel, i, uvec4(key, 0u, 0u, 0u));
#else
    keys[array_slot(pixel, i, K)] = key;
#endif
}

// Leaves the nearer of two keys in the slot; the answer is what was there.
uint keep_nearer(uvec2 pixel, uint i, uint key)
{
#if ARRAY_IS_IMAGE
    return imageAtomicMin(fm_image_keys, ivec3(pixel, i), key);
#else
    return atomicMin(keys[array_slot(pixel, i, K)], key);
#endif
}
#endif

#ifdef FM_WRITES_COLOURS
void put_colour(uvec2 pixel, uint i, uint colour)
{
#if ARRAY_IS_IMAGE
    fm_store_colours(pixel, i, uvec4(colour, 0u, 0u, 0u));
#else
    colours[array_slot(pixel, i, K)] = colour;
#endif
}
#endif

#if DEPTH_BITS == DEPTH_BITS_PUBLISHED
const float NEAR = 0.001, FAR = 50.0, SCALE = 4294967295.0; // its planes unless fitted to the scene

// Every pass must find the same key, so no compiler may round otherwise in one of them: precise. At
// most 0.02 (2^32 - 1): the conversion to an integer is defined.
uint key_of(float depth)
{
    precise float along = (depth - NEAR) / FAR;
    precise float scaled = max(along, 0.0) * SCALE;
    return uint(scaled);
}

// The first float with this key, if it is one near the inverse; several may share it.
float depth_of(uint key)
{
    uint bits = floatBitsToUint(float(key) / SCALE * FAR + NEAR) - 8u;
    FM_LOOP for (uint i = 0u; i < 16u && key_of(uintBitsToFloat(bits)) < key; ++i)
        ++bits;
    return uintBitsToFloat(bits);
}
#else
uint key_of(float depth)
{
    return fm_pack(depth, 0u).x;
}
float depth_of(uint key)
{
    return uintBitsToFloat(key);
}
#endif
