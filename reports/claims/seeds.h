/* Seeds are draws of the same inputs: what a claim is about scatters between them, and so, by
 * Student's t, is less sure. */
#ifndef FM_CLAIM_SEEDS_H
#define FM_CLAIM_SEEDS_H

#include "points.h"

/* The interval of a mean over `count` seeds, whose values these are: as it is, by launches, widened
 * by how far the seeds are apart. Of one seed it stays. */
fm_interval seeds_widen(fm_interval mean, const double *values, size_t count);

/* The claim is judged of each seed: it is an exact one (an `equals` without tolerance), or
 * required, or of form `mean`, which takes means itself, or `images`. Of others seeds are joined,
 * and what compares points must not look at the seed of their rows. */
bool seeds_stay_apart(const fm_claim *claim);

/* Points that differ in their seed alone become one, their mean, unless they stay apart. Rows that
 * are lost are counted by the same key: a point with a lost seed is incomplete, and lost seeds
 * without a point are one that is missing. Out of memory is remembered in `failed`. */
void seeds_join(fm_claim_points *points, const fm_claim *claim);

#endif
