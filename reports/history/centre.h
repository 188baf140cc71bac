/* One number of a night: the middle of its launches. */
#ifndef FM_HISTORY_CENTRE_H
#define FM_HISTORY_CENTRE_H

#include <stddef.h>

typedef struct fm_centre {
    double ratio;          /* NAN: no launch */
    double standard_error; /* of its logarithm; NAN: one launch, or three, of which one is kept */
    size_t launches;
} fm_centre;

/* The geometric mean of ratios above 0, a tenth of them left out at either end (rounded up; none of
 * two). Launches on a busy machine gather at two loads, and the median of so many then jumps from
 * one to the other: to know a ratio as well, it takes two to four times as many launches
 * (tests/reports/alarm_test.c). Standard error: of the winsorised logarithms (Tukey and McLaughlin
 * 1963). The ratios are reordered. */
fm_centre centre_of(double *ratios, size_t count);

#endif
