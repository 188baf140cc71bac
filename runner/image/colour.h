/* Colours as FLIP needs them: linear RGB of BT.709, XYZ, CIELab and its linear relative YCxCz, all
 * relative to the white of D65. */
#ifndef FM_COLOUR_H
#define FM_COLOUR_H

#include <math.h>
#include <stdint.h>
#include <string.h>

/* RGB to XYZ, in the exact fractions that BT.709's primaries and D65 (0.3127, 0.3290) give. The
 * rows add up to the white. */
static const double colour_xyz[3][3] = {
    { 10135552.0 / 24577794, 8788810.0 / 24577794, 4435075.0 / 24577794 },
    { 2613072.0 / 12288897, 8788810.0 / 12288897, 887015.0 / 12288897 },
    { 1425312.0 / 73733382, 8788810.0 / 73733382, 70074185.0 / 73733382 },
};

static inline double srgb_to_linear(double coded)
{
    return coded <= 0.04045 ? coded / 12.92 : pow((coded + 0.055) / 1.055, 2.4);
}

static inline double linear_to_srgb(double linear)
{
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * pow(linear, 1 / 2.4) - 0.055;
}

/* Rec. 709, of linear values. */
static inline float colour_luminance(const float rgb[3])
{
    return 0.2126f * rgb[0] + 0.7152f * rgb[1] + 0.0722f * rgb[2];
}

/* Of x from about 1e-37; correctly rounded or one step off. Without branch or call, so that a loop
 * over pixels becomes vector instructions: a third of the exponent, then two steps of Halley's. */
static inline float colour_cube_root(float x)
{
    uint32_t bits;
    float root;
    memcpy(&bits, &x, sizeof bits);
    bits = bits / 3 + 0x2a5119f2u;
    memcpy(&root, &bits, sizeof root);
    for (int i = 0; i < 2; i++) {
        const float cube = root * root * root;
        root *= (cube + 2 * x) / (2 * cube + x);
    }
    return root;
}

/* CIELab's curve: a cube root, with a line near black. */
static inline float colour_lab_curve(float t)
{
    const float root = colour_cube_root(t), line = t * (841.0f / 108) + 4.0f / 29;
    return t > 216.0f / 24389 ? root : line;
}

#endif
