/* Arithmetic with intervals. */
#ifndef FM_INTERVAL_H
#define FM_INTERVAL_H

#include "base/stats.h"

/* Arithmetic of independent medians with 95 % intervals: limits are recovered from the parts'
 * (Donner and Zou's MOVER), for ratios of their logarithms. */
fm_interval interval_ratio(fm_interval dividend, fm_interval divisor);
fm_interval interval_difference(fm_interval minuend, fm_interval subtrahend);

#endif
