/* What the same code gives every time, and what therefore needs no statistics: status, memory,
 * counts of fragments, errors, the picture. */
#ifndef FM_AB_OUTPUTS_H
#define FM_AB_OUTPUTS_H

#include "base/text.h"
#include "results/results.h"

/* In rising order of merit. */
typedef enum ab_outputs {
    AB_OUTPUTS_WORSE,  /* another status, more bytes, more errors, perhaps beside what is better */
    AB_OUTPUTS_DIFFER, /* others, and nobody can say which are better: the picture, counts */
    AB_OUTPUTS_EQUAL,
    AB_OUTPUTS_BETTER,
    AB_OUTPUTS_COUNT
} ab_outputs;
const char *ab_outputs_name(ab_outputs outputs); /* "worse", "differ", "equal", "better" */

/* Errors that differ by less are equal: what drivers round. */
#define AB_ERROR_ROUNDING 1e-6

/* One side of a case. */
typedef struct ab_output_side {
    const fm_case_result *result;
    bool is_racy; /* its fragments and pictures need not repeat: the trait */
} ab_output_side;

/* Compares launches 0, and the status of all. changes: gets "bytes_allocated 8 -> 12; status ok ->
 * crash", or nothing; it may fail. Where a side is racy, or drew several pictures, its memory and
 * the scene alone are compared. Metrics that one side lacks are not. */
ab_outputs outputs_compare(fm_text *changes, const ab_output_side *base, const ab_output_side *now);

#endif
