/* Which rows a claim's selections mean. */
#ifndef FM_CLAIM_MATCH_H
#define FM_CLAIM_MATCH_H

#include "read/claim.h"
#include "read/result_files.h"

/* Where rows come from. */
typedef struct fm_claim_rows {
    const fm_result_files *results;
    const bool *takes;      /* [results->count]: the figure's own cases; NULL: all */
    const fm_table *memory; /* rows of memory.csv; NULL: none */
    const char *figure;     /* id, for rows of memory.csv */
} fm_claim_rows;

/* Row of summary.csv: all tests of the selection are met. */
bool match_row(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row);
/* Row of memory.csv: the same, and it belongs to the figure. */
bool match_memory_row(const fm_claim_selection *selection, const fm_claim_rows *rows, size_t row);
/* The row belongs to the figure and its device can say something about the claim. */
bool match_takes(const fm_claim *claim, const fm_claim_rows *rows, size_t row);

#endif
