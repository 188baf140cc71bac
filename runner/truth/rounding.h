/* What a compositor that rounds after each fragment may be off: keys `accumulate` and `composite`.
 *
 * The compositor (methods/common/emit.glsl) keeps C, a colour, and T, what shows behind it. With
 * the format's rounding r, and colour c and alpha a of a fragment as the format has them, it does
 *     front to back   C = r(C + c T)          T = r(T (1 - a))
 *     back to front   C = r(c + C (1 - a))    T as above
 * r moves a value x by half a step of the format at x; also, front to back, by no more than c T,
 * since C itself is one of the format's values. Reading c and a moves them by half a step, too.
 * Let g be the most that any of the fragments lets through, c the largest of their colours, t and s
 * what T and C are at most without rounding, h what T is at most with it, e and E what rounding has
 * moved them by:
 *     h' <= r(g h), since r keeps the order of values
 *     e' <= g e + read h + half(h), and no more than t' or h', the larger one
 *     E' <= E + c e + read h + min(half(s' + E), (c + read) h)   front to back
 *     E' <= g E + read (1 + s + E) + half(s' + E)                back to front
 * None of it hangs on the order of the fragments, so it holds in each order that ties allow. What
 * float32 rounds beside is not in it (image_rounding). */
#ifndef FM_ROUNDING_H
#define FM_ROUNDING_H

#include "model/settings.h"
#include "scene/scene.h"

/* The case's keys; zero rounds to float32, front to back. */
typedef struct fm_rounding {
    fm_accumulate accumulate;
    fm_composite composite;
} fm_rounding;

/* What any channel of a pixel may be off that composites `most` of these fragments, whatever which
 * and in whatever order. 0 for float32. */
double rounding_bound(fm_rounding rounding, const fm_fragment *fragments, uint32_t count,
                      uint32_t most);

/* The step from one value of the format to the next, at this value. */
double rounding_ulp(fm_accumulate format, double value);

/* The distance of one pixel's channels from a range (ties.h) in such steps, the largest. Alpha is
 * kept as 1 - alpha: its step is that of the larger of both. INFINITY: a channel is no number. */
double rounding_ulps_apart(fm_accumulate format, const double low[4], const double high[4],
                           const float rgba[4]);

#endif
