/* The rank-sum test of two samples, exact (Wilcoxon 1945; Mann and Whitney 1947,
 * doi:10.1214/aoms/1177730491): are the later nights slower than those before? */
#ifndef FM_DECIDE_RANK_SUM_H
#define FM_DECIDE_RANK_SUM_H

#include "decide.h"

/* So many values are taken at most, of both samples together. */
enum { RANK_SUM_VALUES = 200 };

/* How likely a sum of ranks as far off as this one is, if each choice of the values that are in the
 * second sample has the same chance. */
typedef struct fm_rank_sum {
    double p_greater; /* small if the second sample is above the first */
    double p_less;    /* small if it is below */
    double p_two_sided;
    double shift; /* by how much it is above: the median of all differences of a value of the second
                     and one of the first (Hodges and Lehmann 1963) */
} fm_rank_sum;

/* values[0 .. first_count) are the first sample, the others up to count the second. Equal values
 * share the mean of their ranks; the p-values are exact with these, too. 40 values take 0.2 ms, 200
 * take 0.3 s.
 *
 * FM_INVALID: a sample is empty, there are more than RANK_SUM_VALUES, or one is infinite or no
 * number; FM_NO_MEMORY. */
fm_status rank_sum_test(fm_rank_sum *test, const double *values, size_t first_count, size_t count,
                        fm_error *err);

/* p_two_sided of all places where the values can be parted, at the cost of one test: p[i] for
 * first_count = i, from 1 to count - 1; p[0] is 1. As above; the shift is not computed. */
fm_status rank_sum_splits(double *p, const double *values, size_t count, fm_error *err);

#endif
