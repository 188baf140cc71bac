/* Which cases of a run belong to a figure. */
#ifndef FM_READ_FIGURE_CASES_H
#define FM_READ_FIGURE_CASES_H

#include "paper_figure.h"
#include "result_files.h"

/* The cases that figures.csv lists for the figure; where the run has no figures.csv, those of the
 * methods, scenes and feeds that the figure's `run` names. */
typedef struct fm_figure_cases {
    const fm_paper_figure *figure; /* borrowed */
    bool is_listed;                /* the run has a figures.csv */
    uint64_t bit;                  /* of the figure in fm_case_row.figures */
} fm_figure_cases;

fm_figure_cases figure_cases(const fm_result_files *results, const fm_paper_figure *figure);
/* A filter of groups_make; cases: an fm_figure_cases. */
bool figure_takes_case(const fm_case_row *result, const void *cases);

#endif
