/* The level of one test where there are many of them: over the cases of a night, and over several
 * looks at one case. */
#ifndef FM_DECIDE_LEVELS_H
#define FM_DECIDE_LEVELS_H

#include <stdint.h>

#include "decide.h"

/* adjusted[count]: the smallest share of false discoveries at which each test would count as one
 * (Benjamini and Hochberg 1995, doi:10.1111/j.2517-6161.1995.tb02031.x). Those with adjusted[i] <=
 * q are together wrong in a share of at most q, on average, if tests are independent or positively
 * dependent. adjusted may be p itself. FM_INVALID: a p-value is not in [0,1], with its index;
 * FM_NO_MEMORY. count may be 0, and is not limited. */
fm_status levels_adjust(double *adjusted, const double *p, size_t count, fm_error *err);

/* Splits the level of a test that is looked at several times, before anything is measured.
 * levels[count]  how small the p-value of each look must be
 * looks[count]   how many pairs or launches there are then; rising, the last is the plan's end
 * Each look gets the share of the level that it has of the data: of (20, 40) half each, of (5, 10,
 * 20, 40) an eighth, an eighth, a quarter, a half. The levels add up to `level`, so that all looks
 * together are wrong at most that often, whatever the test and however the looks depend on each
 * other (Bonferroni). Tighter splits (Pocock, O'Brien and Fleming) need normal statistics, which
 * those of few pairs are not. An interval at a look has coverage 1 - levels[i]: all of them hold
 * with 1 - level. FM_INVALID: no look, looks that do not rise from 1 on, or a level not between 0
 * and 1. */
fm_status levels_split(double *levels, const uint32_t *looks, size_t count, double level,
                       fm_error *err);

#endif
