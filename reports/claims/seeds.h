/* Seeds are draws of the same inputs: what a claim is about scatters between them, and so, by
 * Student's t, is less sure. */
#ifndef FM_CLAIM_SEEDS_H
#define FM_CLAIM_SEEDS_H

#include "points.h"

/* The interval of a mean over `count` seeds, whose values these are: as it is, by launches, widened
 * by how far the seeds are apart. Of one seed it stays. */
fm_interval seeds_widen(fm_interval mean, const double *values, size_t count);

/* Points that differ in their seed alone become one, their mean. They stay apart where the claim is
 * an exact one (an `equals` without tolerance) or required: then it is one of each seed; and of the
 * forms `mean`, which takes means itself, and `images`. Out of memory is remembered in `failed`. */
void seeds_join(fm_claim_points *points, const fm_claim *claim);

#endif
