/* Counts of what happened k times of n. */
#ifndef FM_DECIDE_BINOMIAL_H
#define FM_DECIDE_BINOMIAL_H

#include <stdint.h>

#include "base/stats.h"
#include "decide.h"

enum { BINOMIAL_TRIES = 1000000 };

/* The chance of k or more of n tries, each of which succeeds with `chance`. 0 <= chance <= 1, n at
 * most BINOMIAL_TRIES. The relative error of tails above 1e-300 is below 1e-11, and below
 * 1e-12 up to 1000 tries. */
double binomial_at_least(uint32_t k, uint32_t n, double chance);

/* The share k / n, with Clopper and Pearson's interval (1934, doi:10.1093/biomet/26.4.404): all
 * chances under which neither so few nor so many are rarer than (1 - coverage) / 2. It holds the
 * true chance in at least `coverage` of cases, whatever n. FM_INVALID: n is 0 or above
 * BINOMIAL_TRIES, k above n, or a coverage not between 0 and 1. */
fm_status binomial_interval(fm_interval *interval, uint32_t k, uint32_t n, double coverage,
                            fm_error *err);

#endif
