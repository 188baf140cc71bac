#include "kb-mha/field.glsl"

// The code of a record (depth bits, colour): twelve numbers modulo P, of its locator x, which is a hash of it, and its four
// halves y of words:
//   0 to 3   1, x, x^2, x^3
//   4 to 7   y_l
//   8 to 11  x y_l
// Sums of codes, each times a whole weight, are what decode.glsl takes apart again.
const uint CODE_WORDS = 12u;

uint locator(uvec2 record)
{
    uint h = record.x * 0x9E3779B1u ^ (record.y * 0x85EBCA77u + 0x165667B1u);
    h = (h ^ h >> 15) * 0x2C1B3C6Du;
    h = (h ^ h >> 12) * 0x297A2D39u;
    return reduced(h ^ h >> 15);
}
uvec4 halves(uvec2 record)
{
    return uvec4(record.x & 0xFFFFu, record.x >> 16, record.y & 0xFFFFu, record.y >> 16);
}
uint[CODE_WORDS] code_of(uvec2 record)
{
    uint x = locator(record), square = times(x, x);
    uvec4 y = halves(record);
    return uint[CODE_WORDS](1u, x, square, times(square, x), y.x, y.y, y.z, y.w, times(x, y.x),
                            times(x, y.y), times(x, y.z), times(x, y.w));
}
