/* What becomes of a claim: one of four words, what was measured, and why. */
#ifndef FM_CLAIM_VERDICT_H
#define FM_CLAIM_VERDICT_H

#include "base/stats.h"

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

#endif
