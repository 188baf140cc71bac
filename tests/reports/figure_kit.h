/* Figures drawn from fabricated results. */
#ifndef FM_FIGURE_KIT_H
#define FM_FIGURE_KIT_H

#include "claims_kit.h"
#include "draw/figure_charts.h"
#include "read/figure_cases.h"
#include "read/group.h"

/* A directory with results and the figure f-1, both read. */
typedef struct fixture {
    char directory[64];
    fm_result_files *results;
    fm_paper_figure *figure;
} fixture;

/* figures_csv: NULL: the run has none. */
void fixture_open(fixture *made, const fakes *rows, const char *figure, const char *figures_csv);
void fixture_close(fixture *made);
/* The figure's cases, as one of its charts has them. */
void fixture_groups(fm_groups *groups, const fixture *in, const fm_figure_chart *chart);

/* One chart of f-1, drawn for the first group of its cases. */
typedef struct drawing {
    fixture with;
    fm_groups groups;
    fm_chart chart;
} drawing;

void drawing_open(drawing *made, const fakes *rows, const char *figure, const char *figures_csv,
                  size_t chart);
void drawing_close(drawing *made);

#endif
