/* The claims of a paper, with what became of them. */
#ifndef FM_VERDICT_TABLE_H
#define FM_VERDICT_TABLE_H

#include "base/text.h"
#include "claims/verdicts.h"

/* Nothing where verdicts is NULL or has none of that paper. */
void verdict_table_add(fm_text *page, const fm_claim_results *verdicts, const char *paper);

#endif
