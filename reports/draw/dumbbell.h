/* Two runs as dumbbells: of each case a line from what it was to what it is. */
#ifndef FM_DUMBBELL_H
#define FM_DUMBBELL_H

#include "chart.h"
#include "compare/comparison.h"

enum { FM_DUMBBELL_CASES = 60 };

/* A row a case that has a time in both, the worst on top, at most FM_DUMBBELL_CASES; x is the
 * quantity, on a log scale. Hollow: BASE. Filled, coloured by the verdict: NEW. FM_UNSUPPORTED: no
 * case has a time in both. The caller frees *chart, after a failure too. */
fm_status dumbbell_chart(fm_chart *chart, const fm_comparison *comparison, fm_error *err);

#endif
