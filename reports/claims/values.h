/* The number of a row that a selection means. */
#ifndef FM_CLAIM_VALUES_H
#define FM_CLAIM_VALUES_H

#include "match.h"
#include "read/interval.h"

/* The sum of the selection's metrics for a case, as case_interval has it: exact if none of them is
 * a time; of one launch a time has no interval. All NAN: it has none of them. */
fm_interval value_measured(const fm_claim_selection *selection, const fm_claim_rows *rows,
                           const fm_case_row *result);
/* The bytes that the selection's formula gives for a case; not finite: the case lacks a number. */
fm_interval value_by_formula(const fm_claim_selection *selection, const fm_case_row *result);
/* The sum of the selection's metrics in a row of memory.csv; NAN: one is missing. */
double value_of_memory(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row);
/* Of several rows to compare with, the greatest where the selection says so, else the least. */
bool value_is_taken(const fm_claim_selection *selection, double value, double best);

#endif
