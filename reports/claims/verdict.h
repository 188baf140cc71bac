/* What becomes of a claim: one of five words, what was measured, and why. */
#ifndef FM_CLAIM_VERDICT_H
#define FM_CLAIM_VERDICT_H

#include <stdbool.h>

#include "base/stats.h"

typedef enum fm_verdict_kind {
    FM_VERDICT_HOLDS,
    FM_VERDICT_IN_PART, /* it holds where it could be judged, which is not all that is claimed */
    FM_VERDICT_UNCLEAR,
    FM_VERDICT_FAILS,
    FM_VERDICT_NOT_TESTABLE,
    FM_VERDICT_COUNT
} fm_verdict_kind;

typedef struct fm_verdict {
    fm_verdict_kind kind;
    fm_interval measured; /* what decided; NAN: nothing */
    size_t judged, total; /* points; fewer were judged than there are where some gave no result */
    bool is_elsewhere; /* on a scene that the figure does not have: --smoke or --scene put it there
                        */
    char reason[512];
} fm_verdict;

enum { FM_VERDICT_WORDS_BYTES = 96 };

/* "holds", "holds in part", "unclear", "fails", "not testable here". */
const char *verdict_name(fm_verdict_kind kind);
/* The same, but in part: "holds for 3 of 10 points", "holds on another scene". */
void verdict_words(char words[FM_VERDICT_WORDS_BYTES], const fm_verdict *verdict);

#endif
