/* Which rows a claim's selections mean. */
#ifndef FM_CLAIM_MATCH_H
#define FM_CLAIM_MATCH_H

#include "points.h"

/* Row of summary.csv: all tests of the selection are met. */
bool match_row(const fm_selection *selection, const fm_claim_rows *rows, size_t row);
/* Row of memory.csv: the same, and it belongs to the figure. */
bool match_memory_row(const fm_selection *selection, const fm_claim_rows *rows, size_t row);
/* The row belongs to the figure and its device can say something about the claim. */
bool match_takes(const fm_claim *claim, const fm_claim_rows *rows, size_t row);
/* Same scene, size, fragments, device and feed, but for the free columns. */
bool match_workload(const fm_case_row *a, const fm_case_row *b, const fm_name_list *free_columns);
/* The value of key in "key=value key=value"; "" when it is not there. */
void match_option(char value[128], const char *options, const char *key);
/* ", n 128, k 8": the workload's columns that differ within the figure's cases. */
void match_name_columns(char *name, size_t room, const fm_claim_rows *rows,
                        const fm_case_row *result);

#endif
