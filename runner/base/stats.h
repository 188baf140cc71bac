/* Medians and their intervals.
 *
 * The unit is the launch, a process of its own. Frames of one launch share its memory's layout, its
 * shaders and its moment of the machine, so that many frames of one launch say little about the
 * next launch. A launch therefore counts as one number, the median of its frames. */
#ifndef FM_STATS_H
#define FM_STATS_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Three numbers alike: it is exact. low and high NAN: there is no interval. */
typedef struct fm_interval {
    double median, low, high;
} fm_interval;

/* Rising; NAN last. */
void stats_sort(double *values, size_t count);

/* Median of values, which are then sorted; NAN for none. Even counts: the mean of the middle two.
 */
double stats_median(double *values, size_t count);

fm_interval interval_exact(double value);
/* Whether it has ends: of one launch there are none. */
bool interval_is_known(const fm_interval *interval);

/* Median of one number a launch, with its 95 % interval. The values are reordered.
 *
 * From 6 launches on the ends are order statistics of the launches, interpolated between the two
 * that are nearest to 95 % (Hettmansperger and Sheather 1986). Of 5 launches they are the least and
 * the greatest, which hold 93.75 %. Of fewer not even these reach it, so that the range is widened
 * to both sides, by 0.24, 0.82 and 5.85 of itself for 4, 3 and 2 launches; of positive values this
 * is done in logarithms. One launch: no interval. None: all NAN.
 *
 * Assumed is that launches are independent and alike; of fewer than 5 also that they scatter like a
 * normal distribution, in logarithms where values are positive. What a machine that is busy all the
 * time does differently is not in the interval.
 *
 * Coverage in 10 000 draws of three cases' launches, measured beside other work on two processors
 * (tests/base/coverage_test.c; their logarithms scatter by 0.21 to 0.32): 93.8 to 95.9 % with 3
 * launches, 93.7 to 94.2 % with 5, 95.1 to 95.4 % with 10. With 2 it is 90 to 93 %: two launches
 * often meet the same load, and then do not see it. */
fm_interval stats_interval(double *values, size_t count);
/* The same with another coverage, of at least 0.95 and below 1. The ends are order statistics where
 * those of so few launches reach it, and else the range is widened as that of fewer than 5 is: of 5
 * launches by 0.49 of itself for 99.4 %, of 10 for no coverage up to 99.8 %. */
fm_interval stats_interval_at(double *values, size_t count, double coverage);

/* Samples in groups (launches): group_of[i] < group_count says where values[i] comes from. */
typedef struct fm_samples {
    const double *values;
    const uint32_t *group_of;
    size_t count;
    uint32_t group_count;
    double coverage; /* of the interval; 0: 0.95 */
} fm_samples;

/* stats_interval_at of the medians of the groups. Groups without a sample are left out. All NAN: no
 * samples, or no memory. */
fm_interval stats_by_launch(const fm_samples *samples);

/* Student's t that 95 % of means lie within, by degrees of freedom (1 and more; INFINITY for 0). */
double stats_student(size_t degrees);

#endif
