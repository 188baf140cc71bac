/* Steps in a series: since when is it slower? */
#ifndef FM_DECIDE_STEPS_H
#define FM_DECIDE_STEPS_H

#include "rank_sum.h"

/* From here on the values are others. */
typedef struct fm_step {
    size_t index;      /* of the first value behind it */
    double shift;      /* by how much the values up to the next step are above those since the last;
                          of logarithms exp of it is a ratio */
    double p_adjusted; /* of the test that found it, for all places where it could have been */
} fm_step;

typedef struct fm_steps_desc {
    double level; /* of finding any step where there is none */
    size_t least; /* values on each side of a step; 0: 3 */
} fm_steps_desc;

/* Parts the series where the exact rank-sum test of both sides has its smallest p, if this, times
 * the number of places (Bonferroni), is at most `level`; then both sides in the same way, each at
 * its share of the level, by length. Of values that are independent and alike it finds any step in
 * a share of at most `level`, whatever their distribution. One odd value is no step. A drift is, if
 * it is larger than the noise: hand in ratios to a reference that drifts alike.
 *
 * steps       [count]: those found, in the order of their index; the caller's
 * At level 5 % the step from 27 values to 3 others is the shortest that can be found at the end of
 * 30: its p, 1 / 2030, times 25 places is 0.012. To look every night at the last few alone, split
 * the level over the nights (levels.h), and ask rank_sum_test.
 *
 * FM_INVALID: no value, more than RANK_SUM_VALUES, one that is infinite or no number, or a level
 * not between 0 and 1; FM_NO_MEMORY. 128 values take 0.04 s, 200 take
 * 0.3 s. */
fm_status steps_find(fm_step *steps, size_t *step_count, const double *values, size_t count,
                     const fm_steps_desc *desc, fm_error *err);

#endif
