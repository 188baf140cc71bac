/* Rows of summary.csv become points of a claim. */
#ifndef FM_CLAIM_SUMMARY_POINTS_H
#define FM_CLAIM_SUMMARY_POINTS_H

#include "points.h"

/* Adds the points of the claim's selection of that index. Each row that it means is combined with
 * the rows of `minus`, `over` and `over_minus` of its workload; one that gives no point is lost,
 * with the reason. Of selections that take the least or the greatest there is one
 * point a workload. */
void summary_points_add(fm_claim_points *points, const fm_claim *claim, const fm_claim_rows *rows,
                        size_t index);

#endif
