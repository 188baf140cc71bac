/* Medians and their intervals. */
#ifndef FM_STATS_H
#define FM_STATS_H

#include <stddef.h>
#include <stdint.h>

typedef struct fm_interval {
    double median, low, high;
} fm_interval;

/* Median of values, which are reordered; NAN for none. Even counts: the mean of the middle two. */
double stats_median(double *values, size_t count);

/* Samples in groups (launches): group_of[i] < group_count says where values[i] comes from. */
typedef struct fm_samples {
    const double *values;
    const uint32_t *group_of;
    size_t count;
    uint32_t group_count;
} fm_samples;

/* Median with its 95 % percentile-bootstrap interval: 1 000 replicates that draw launches with
 * replacement, then samples within each drawn launch. One sample: low = high = median.
 * Deterministic for a seed. All three NAN: no samples, or no memory. */
fm_interval stats_bootstrap(const fm_samples *samples, uint64_t seed);

/* Student's t that 95 % of means lie within, by degrees of freedom (1 and more; INFINITY for 0). */
double stats_student(size_t degrees);

#endif
