/* A map of errors, pooled into a few numbers. */
#ifndef FM_POOL_H
#define FM_POOL_H

#include <stddef.h>
#include <stdint.h>

#include "base/error.h"

/* NAN where there is no pixel. */
typedef struct fm_pooled {
    double mean; /* summed in double precision */
    /* Half of the sum of all errors comes from pixels with an error up to this one. Of a picture
     * that is right but for a few pixels the median says 0; this says how wrong these are. */
    double weighted_median;
    double p95, p99; /* percentiles by nearest rank */
    double max;
} fm_pooled;

/* values: [count], from 0, may be infinite, none of them NAN; sorted by this call.
 * spare: room for as many. */
void pool_values(fm_pooled *pooled, float *values, float *spare, size_t count);

/* Sorts values from 0 up, INFINITY included. spare: room for as many. */
void pool_sort(float *values, float *spare, size_t count);

#endif
