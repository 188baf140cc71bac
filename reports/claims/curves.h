/* Forms that judge curves: the points of one series, x rising. */
#ifndef FM_CLAIM_CURVES_H
#define FM_CLAIM_CURVES_H

#include "judging.h"

/* Judges each curve of the points apart; one with fewer points than its form needs is noted. */
void curves_judge(judging *to);

#endif
