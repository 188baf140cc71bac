// A depth as an integer that compares as the depth does.
//   exact      the float's bits
//   published  uint((z - near) / far * (2^32 - 1)) in float arithmetic, as the k+-buffer paper's code: the
//              division merges some neighbouring floats, and what lies before `near` becomes 0
// A method without this option has the float's bits.
#include "common/array.glsl"

#define KEY uint
const uint EMPTY = 0xFFFFFFFFu;

uint key_at(uvec2 pixel, uint i)
{
#if ARRAY_IS_IMAGE
    return fm_load_keys(pixel, i).x;
#else
    return keys[array_slot(pixel, i, K)];
#endif
}

#if defined(DEPTH_BITS_PUBLISHED) && DEPTH_BITS == DEPTH_BITS_PUBLISHED
#define EQUAL_DEPTHS_MERGE 0
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
#define EQUAL_DEPTHS_MERGE 1 // of equal depths one is kept, and every slot gets a colour
uint key_of(float depth)
{
    return fm_pack(depth, 0u).x;
}
float depth_of(uint key)
{
    return uintBitsToFloat(key);
}
#endif
