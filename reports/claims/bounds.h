/* Bounds of a claim, and on which side of them an interval lies. */
#ifndef FM_CLAIM_BOUNDS_H
#define FM_CLAIM_BOUNDS_H

#include "read/claim.h"
#include "read/interval.h"
#include "verdict.h"

/* The bounds as they are judged: widened by the tolerance; infinite: none. */
void bounds_of(double bounds[2], const fm_claim *claim);
/* Where the interval lies: inside the bounds (holds), outside (fails), or across one (unclear). */
fm_verdict_kind bounds_judge(const fm_claim *claim, fm_interval value);
/* How far the value is from the nearest bound of the paper, as a share of it; below 0 outside. */
double bounds_margin(const fm_claim *claim, double value);

#endif
