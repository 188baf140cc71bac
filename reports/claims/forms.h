/* Forms judge points. */
#ifndef FM_CLAIM_FORMS_H
#define FM_CLAIM_FORMS_H

#include "points.h"

typedef enum fm_verdict_kind {
    FM_VERDICT_HOLDS,
    FM_VERDICT_UNCLEAR,
    FM_VERDICT_FAILS,
    FM_VERDICT_NOT_TESTABLE,
    FM_VERDICT_COUNT
} fm_verdict_kind;

typedef struct fm_verdict {
    fm_verdict_kind kind;
    fm_interval measured; /* what decided; NAN: nothing */
    char reason[512];
} fm_verdict;

/* "holds", "unclear", "fails", "not testable here". */
const char *verdict_name(fm_verdict_kind kind);

/* Judges the points of a claim, of which there is at least one. FM_IO, FM_INVALID: a damaged
 * picture. */
fm_status claim_judge(fm_verdict *verdict, const fm_claim *claim, const fm_claim_rows *rows,
                      const fm_claim_points *points, fm_error *err);

/* The bounds as they are judged: widened by the tolerance; infinite: none. */
void bounds_of(double bounds[2], const fm_claim *claim);
/* Where the interval lies: inside the bounds, outside, or across one. */
fm_verdict_kind bounds_judge(const fm_claim *claim, fm_interval value);

#endif
