/* Arithmetic with intervals. */
#ifndef FM_INTERVAL_H
#define FM_INTERVAL_H

#include "base/stats.h"

/* Both are of independent medians with 95 % intervals. If one of them has none (one launch), the
 * result has none. The limits are recovered from those of the
 * parts (Donner and Zou's MOVER), of a ratio from their logarithms. Where the divisor's interval
 * holds 0, that of the ratio is infinite. */
fm_interval interval_ratio(fm_interval dividend, fm_interval divisor);
fm_interval interval_difference(fm_interval minuend, fm_interval subtrahend);

#endif
