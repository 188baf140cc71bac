/* When launches are enough: looks planned beforehand, and the interval of a median at each.
 *
 * Who measures until an interval is narrow stops where it happens to be narrow, so that an interval
 * of 95 % then holds less often. Here the looks are planned before anything is measured, the
 * level of 5 % is split over them (levels.h), and the interval at a look has the coverage that its
 * share leaves. All of them together hold the median with 95 %, so that the one at which it stops
 * does, whatever the rule to stop.
 *
 * The intervals are those of base/stats.h, not the bootstrap of median.h, which never goes beyond
 * the least and the greatest value: those of 5 launches hold 93.75 %, and the first look of four
 * wants 99.4 %. */
#ifndef FM_DECIDE_PRECISION_H
#define FM_DECIDE_PRECISION_H

#include <stdbool.h>
#include <stdint.h>

#include "base/stats.h"

/* The first look, and the last one where nobody says. */
enum { PRECISION_FIRST = 5, PRECISION_LAST = 40, PRECISION_LOOKS_MAX = 16 };

typedef struct fm_precision_looks {
    uint32_t launches[PRECISION_LOOKS_MAX]; /* rising */
    double levels[PRECISION_LOOKS_MAX];     /* of the interval at each */
    size_t count;
} fm_precision_looks;

/* 5, 10, 20 and so on, twice as many each time, as long as twice a look is no more than the last:
 * of 40 launches 5, 10, 20, 40. last: 1 to 1000 launches. */
void precision_looks(fm_precision_looks *looks, uint32_t last);
/* Whether there is a look after so many launches. */
bool precision_has_look(uint32_t last, uint32_t launches);
/* The coverage of an interval of so many launches: that of the first look that has them. */
double precision_coverage(uint32_t last, uint32_t launches);
/* Half of the interval over its median; 0 where all three are 0; NAN: no interval. */
double precision_half_width(const fm_interval *interval);

#endif
