/* The values of one chart of a figure: where a case stands on x, what it has on y, which cases are
 * one series. All kinds of charts ask here; nothing here draws. */
#ifndef FM_FIGURE_VALUES_H
#define FM_FIGURE_VALUES_H

#include "chart.h"
#include "read/group.h"
#include "read/interval.h"
#include "read/paper_figure.h"

/* A growing list of numbers. Starts as {0}. */
typedef struct fm_numbers {
    double *items; /* owned */
    size_t count, capacity;
} fm_numbers;

/* One chart being made. Its numbers are owned; all else is borrowed. */
typedef struct fm_figure_job {
    fm_chart *chart;
    const fm_paper_figure *figure;
    const fm_figure_chart *from; /* what is to be drawn */
    const fm_result_files *results;
    const fm_group *group;
    fm_numbers places; /* the distinct x of its cases, rising */
    fm_numbers x, y;   /* values that the axes must hold */
} fm_figure_job;

void figure_job_free(fm_figure_job *job); /* the numbers */

/* Adds a value that the axis of y must hold, and all of a point for both axes. Out of memory is
 * remembered in the chart's `failed`. */
void figure_note_y(fm_figure_job *job, double value);
void figure_note_point(fm_figure_job *job, const fm_point *point);

/* x is the scene: a place for each that the figure lists, from 1 on. */
bool figure_is_by_scene(const fm_figure_job *job);
/* Drawn level over all x: x is k, and neither the method nor its workload, n = r k, depends on it.
 */
bool figure_is_level(const fm_figure_job *job, const fm_case_row *result);
/* Where the case stands on x; NAN: nowhere. */
double figure_x(const fm_figure_job *job, const fm_case_row *result);
/* Fills `places`: the x of all measured cases that use x, else of the level ones; at least one when
 * anything is measured. */
void figure_find_places(fm_figure_job *job);
/* The sum of the chart's metrics, with its interval. */
fm_interval figure_y(const fm_figure_job *job, const fm_case_row *result);
/* The case that ratios at x are taken to; NULL: it was not measured there. */
const fm_case_row *figure_base_at(const fm_figure_job *job, double x);

/* Cases that differ in what x is, an option perhaps, are points of one series, which the first of
 * them starts. Numbers are of the group's cases. */
bool figure_is_same_series(const fm_figure_job *job, size_t a, size_t b);
bool figure_starts_series(const fm_figure_job *job, size_t i);

/* How a method looks: as its cases do, else as the manifest says; its title may be NULL. */
fm_method_info figure_look(const fm_figure_job *job, const char *method);

#endif
