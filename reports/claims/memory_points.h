/* Rows of memory.csv become points of a claim: bytes by formula, which need no run. */
#ifndef FM_CLAIM_MEMORY_POINTS_H
#define FM_CLAIM_MEMORY_POINTS_H

#include "points.h"

/* Adds the points of the claim's selection of that index; none where rows->memory is NULL. */
void memory_points_add(fm_claim_points *points, const fm_claim *claim, const fm_claim_rows *rows,
                       size_t index);

#endif
