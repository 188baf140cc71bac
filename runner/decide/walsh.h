/* Hodges and Lehmann's estimate: by how much one side of the pairs is larger. */
#ifndef FM_DECIDE_WALSH_H
#define FM_DECIDE_WALSH_H

#include "base/stats.h"
#include "decide.h"

typedef struct fm_shift {
    fm_interval interval; /* median: the estimate; low and high NAN: too few for that coverage */
    double coverage;      /* what the interval really holds, at least the one asked for; or NAN */
} fm_shift;

/* The median of the means of all pairs of differences, each with itself too (Walsh averages), and
 * the interval of all shifts that the signed-rank test does not reject (Hodges and Lehmann 1963,
 * doi:10.1214/aoms/1177704172; Tukey). It holds the centre in at least `coverage` of cases, if
 * differences are independent and scatter alike to both sides of it; nothing else is assumed. With
 * ties it is wider than it need be. For 95 %: from 6 differences on.
 *
 * FM_INVALID as decide_check, or a coverage not between 0 and 1; FM_NO_MEMORY. */
fm_status walsh_shift(fm_shift *shift, const double *differences, size_t count, double coverage,
                      fm_error *err);

#endif
