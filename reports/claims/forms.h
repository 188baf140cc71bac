/* Forms judge points. */
#ifndef FM_CLAIM_FORMS_H
#define FM_CLAIM_FORMS_H

#include "points.h"
#include "verdict.h"

/* Judges the points of a claim, of which there is at least one. FM_IO, FM_INVALID: a damaged
 * picture. */
fm_status claim_judge(fm_verdict *verdict, const fm_claim *claim, const fm_claim_rows *rows,
                      const fm_claim_points *points, fm_error *err);

#endif
