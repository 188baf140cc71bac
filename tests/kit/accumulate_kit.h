/* The compositor once more, slow and on the host: what an image must hold where it rounds to
 * float16 or unorm8 after each fragment. In float16 bit for bit; in unorm8 but for the last bit of
 * a quotient by 255. */
#ifndef FM_TESTS_ACCUMULATE_KIT_H
#define FM_TESTS_ACCUMULATE_KIT_H

#include <math.h>

#include "truth/rounding.h"

/* Half-precision by arithmetic: the nearest multiple of the step at the value, ties to even. */
static inline float round_half(float value)
{
    int exponent;
    (void)frexpf(value, &exponent);
    const int step = exponent - 11 > -24 ? exponent - 11 : -24;
    return ldexpf(nearbyintf(ldexpf(value, -step)), step);
}

static inline float round_to(fm_accumulate format, float value)
{
    switch (format) {
    case FM_ACCUMULATE_FLOAT16:
        return round_half(value);
    case FM_ACCUMULATE_UNORM8:
        return nearbyintf((value > 1 ? 1 : value) * 255) / 255;
    case FM_ACCUMULATE_FLOAT32:
    case FM_ACCUMULATE_COUNT:
        break;
    }
    return value;
}

/* One fragment on rgb and what shows, from either end. */
static inline void accumulate_one(float kept[4], fm_rounding rounding, uint32_t colour)
{
    const fm_accumulate format = rounding.accumulate;
    float c[4];
    for (int i = 0; i < 4; i++)
        c[i] = round_to(format, (float)(colour >> (8 * i) & 0xFFu) / 255);
    for (int i = 0; i < 3; i++)
        kept[i] = rounding.composite == FM_COMPOSITE_BACK_TO_FRONT
                      ? round_to(format, c[i] + kept[i] * (1 - c[3]))
                      : round_to(format, kept[i] + c[i] * kept[3]);
    kept[3] = round_to(format, kept[3] * (1 - c[3]));
}

/* A pixel of the image: fragments nearest first. */
static inline void accumulate_pixel(float rgba[4], fm_rounding rounding,
                                    const fm_fragment *fragments, uint32_t count)
{
    const bool is_back = rounding.composite == FM_COMPOSITE_BACK_TO_FRONT;
    rgba[0] = rgba[1] = rgba[2] = 0;
    rgba[3] = 1;
    for (uint32_t i = 0; i < count; i++)
        accumulate_one(rgba, rounding, fragments[is_back ? count - 1 - i : i].colour);
    rgba[3] = 1 - rgba[3];
}

#endif
