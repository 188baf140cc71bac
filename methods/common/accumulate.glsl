// What the compositor keeps of a pixel, rounded after each fragment as the runner's key `accumulate` says, alike
// on every device. No value is below 0.
#if FM_ACCUMULATE == 0 // float32: what the device computes
#define FM_PRECISE
vec4 fm_read_colour(vec4 colour)
{
    return colour;
}
vec4 fm_rounded(vec4 value)
{
    return value;
}
#elif FM_ACCUMULATE == 1 // float16: colours that come in, too, so that their products are exact in float32
#define FM_PRECISE precise
// To the nearest half, ties to even: 10 bits behind the first one, below 2^-14 steps of 2^-24. packHalf2x16()
// may round as its device likes. There is no largest value.
vec4 fm_rounded(vec4 value)
{
    uvec4 bits = floatBitsToUint(value);
    vec4 normal = uintBitsToFloat((bits + 0xFFFu + (bits >> 13u & 1u)) & 0xFFFFE000u);
    vec4 subnormal = roundEven(value * 16777216.0) / 16777216.0;
    return mix(normal, subnormal, lessThan(value, vec4(1.0 / 16384.0)));
}
vec4 fm_read_colour(vec4 colour)
{
    return fm_rounded(colour);
}
#else // unorm8: as blending into an RGBA8 target. Of 8-bit values no product lies half way between two.
#define FM_PRECISE precise
vec4 fm_rounded(vec4 value)
{
    return floor(min(value, vec4(1.0)) * 255.0 + 0.5) / 255.0;
}
vec4 fm_read_colour(vec4 colour)
{
    return fm_rounded(colour);
}
#endif
