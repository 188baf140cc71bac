/* Statistics that decide between two versions of a program: which test, which interval, which
 * level.
 *
 * The room runner/decide is functions on arrays of numbers. Nothing here reads a file, knows what a
 * case is, or draws random numbers: the same numbers always give the same answer, to the last bit
 * on one machine. Medians of launches and their intervals are in base/stats.h.
 *
 *   signed_rank.h  is one side of the pairs larger? the exact test
 *   walsh.h        by how much? Hodges and Lehmann's estimate, with the interval of that test
 *   median.h       the median of the pairs' differences, its bootstrap interval, its standard error
 *   rank_sum.h     are later values above earlier ones? the exact test of two samples
 *   steps.h        since when?
 *   levels.h       many tests in a night, and several looks at one of them
 *   precision.h    how many launches are enough for a median
 *   binomial.h     k of n: how often really?
 *
 * A pair is two launches of two versions that ran one after the other. A difference is that of the
 * logarithms of their times, so that exp of it is a ratio. The functions do not care: all hold for
 * any numbers. */
#ifndef FM_DECIDE_H
#define FM_DECIDE_H

#include <stddef.h>

#include "base/error.h"

/* So many values are taken at most: exact answers cost count^2 of memory and count^3 of time. */
enum { DECIDE_VALUES = 1000 };

/* FM_INVALID: no value, more than DECIDE_VALUES, or one that is infinite or no number, with its
 * index. All functions of the room on differences ask this first. */
fm_status decide_check(const double *values, size_t count, fm_error *err);

#endif
