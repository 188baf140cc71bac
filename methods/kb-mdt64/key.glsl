// A fragment as one number, depth in the high word: nearer fragments are smaller.
#include "common/array.glsl"

const uint64_t EMPTY = 0xFFFFFFFFFFFFFFFFul;

uint64_t key_of(float depth, uint colour)
{
    return packUint2x32(uvec2(colour, fm_pack(depth, colour).x));
}
