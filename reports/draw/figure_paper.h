/* The values that a paper prints, beside ours. */
#ifndef FM_FIGURE_PAPER_H
#define FM_FIGURE_PAPER_H

#include "figure_values.h"

/* The paper's points are of what the chart shows. */
bool figure_has_paper(const fm_figure_job *job);
/* The paper's first value for a method at x, of the group's workload; NAN: none is printed. */
double figure_paper_value(const fm_figure_job *job, const char *method, double x);
/* Adds all of the paper's series of the group's workload, hollow and dotted. */
void figure_add_paper(fm_figure_job *job);

#endif
