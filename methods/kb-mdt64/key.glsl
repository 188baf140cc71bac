// A fragment as one number, depth in the high word: nearer fragments are smaller. Slots of keys.
#include "common/array.glsl"

#define KEY uint64_t
const uint64_t EMPTY = 0xFFFFFFFFFFFFFFFFul;

uint64_t key_of(float depth, uint colour)
{
    return packUint2x32(uvec2(colour, fm_pack(depth, colour).x));
}

uint64_t key_at(uvec2 pixel, uint i)
{
    return keys[array_slot(pixel, i, K)];
}
