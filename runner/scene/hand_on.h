/* Which depth methods see of what was rasterised. Of a normal projection it is the same.
 *
 * A reversed one has 1 at the near plane and 0 at the far one, where floats are finest. Methods
 * keep the smallest depths, so what is handed on has to grow from near to far and keep the floats
 * apart. 1 - depth would round them together again; steps of the bits do not:
 *
 *     bits(1.0) - bits(depth)                  grows from near to far, and loses nothing, but is
 *                                              denormal for all depths above 1/2: devices that
 *                                              flush denormals take these for equal
 *     bits(1.0) + 2^23 - 1 - bits(depth)       is the same, one binade up: of a normal depth below
 *                                              1 a normal float below 1
 *
 * The second is handed on, with 0 for 1 and 1 for all depths below 2^-126, which rasterisers flush
 * to 0 anyway. Two normal depths below 1 are as many ulp apart as before. prelude.glsl has the
 * twin, bit for bit.
 */
#ifndef FM_HAND_ON_H
#define FM_HAND_ON_H

#include <string.h>

#include "model/settings.h"

static inline uint32_t hand_on_reversed(uint32_t bits)
{
    const uint32_t one = 0x3F800000u, least_normal = 0x00800000u;
    if (bits >= one)
        return 0;
    return bits < least_normal ? one : one + least_normal - 1 - bits;
}

/* depth: 0..1, as rasterised. */
static inline float hand_on(fm_depth projection, float depth)
{
    uint32_t bits;
    if (projection == FM_DEPTH_NORMAL)
        return depth;
    memcpy(&bits, &depth, sizeof bits);
    bits = hand_on_reversed(bits & 0x7FFFFFFFu); /* -0 is 0 */
    memcpy(&depth, &bits, sizeof depth);
    return depth;
}

#endif
