/* The median of differences, how far it would move in other samples, and its interval. */
#ifndef FM_DECIDE_MEDIAN_H
#define FM_DECIDE_MEDIAN_H

#include "base/stats.h"
#include "decide.h"

typedef struct fm_median {
    fm_interval interval;  /* percentile bootstrap */
    double standard_error; /* of the median; of one value 0, which means nothing */
} fm_median;

/* The bootstrap of the median without random numbers. Drawing as many values as there are, each of
 * them any of these, gives a median whose distribution has a closed form: of the middle one, or the
 * middle two, of n draws (Efron 1979, doi:10.1214/aos/1176344552). This is what a bootstrap of ever
 * more draws tends to; it has no seed, and no noise of its own.
 *   standard_error  its standard deviation (Maritz and Jarrett 1978,
 *                   doi:10.1080/01621459.1978.10480027)
 *   interval        the values beyond which it lies with at most (1 - coverage) / 2 at each end.
 * Percentiles, not BCa: the acceleration of BCa comes from the jackknife, which is inconsistent for
 * medians; and percentiles of log ratios become those of ratios by exp.
 *
 * 95 % intervals hold the median in 93.4 to 94.9 % of 20 000 draws of 6, 10, 20 and 40 values: from
 * measured launches, their pairs, and normal, Cauchy and exponential noise
 * (tests/decide/decide_coverage_test.c). Who needs no less than 95 % takes walsh.h for pairs.
 *
 * FM_INVALID as decide_check, or a coverage not between 0 and 1; FM_NO_MEMORY. The values stay as
 * they are. */
fm_status median_bootstrap(fm_median *median, const double *values, size_t count, double coverage,
                           fm_error *err);

#endif
