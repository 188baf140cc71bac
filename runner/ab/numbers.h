/* What the launches of a run say, each as one number. */
#ifndef FM_AB_NUMBERS_H
#define FM_AB_NUMBERS_H

#include "judge.h"
#include "results/results.h"

/* In milliseconds, as judge.h says: the median of the launch's frames, or the least. NAN: the
 * launch did not go well, or has no such frames. */
double numbers_of_launch(const fm_case_result *result, uint32_t launch, ab_statistic statistic);

#endif
