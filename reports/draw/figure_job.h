/* What the kinds of a figure's charts share. */
#ifndef FM_FIGURE_JOB_H
#define FM_FIGURE_JOB_H

#include "figure_charts.h"
#include "read/interval.h"

/* A growing list of numbers. Starts as {0}. */
typedef struct fm_numbers {
    double *items; /* owned */
    size_t count, capacity;
} fm_numbers;

/* One chart being made. */
typedef struct fm_figure_job {
    fm_chart *chart;
    const fm_paper_figure *figure;
    const fm_figure_chart *from;
    const fm_result_files *results;
    const fm_group *group;
    fm_numbers x, y; /* values that the axes must hold */
} fm_figure_job;

/* Adds a value that an axis must hold. Out of memory is remembered in the chart's `failed`. */
void figure_note_x(fm_figure_job *at, double value);
void figure_note_y(fm_figure_job *at, double value);

/* Drawn level over all x: x is k, and neither the method nor its workload, n = r k, depends on it.
 */
bool figure_is_level(const fm_figure_job *at, const fm_case_row *result);
/* The distinct x of all measured cases that use x, rising; at least one when anything is measured.
 */
size_t figure_distinct_x(double *xs, const fm_figure_job *at);
/* x is the scene: a place for each that the figure lists, from 1 on. */
bool figure_is_by_scene(const fm_figure_job *at);
double figure_x(const fm_figure_job *at, const fm_case_row *result);
/* Of the scene at that place, from 1 on, without its folder. */
const char *figure_scene_name(const fm_figure_job *at, size_t place);
/* A name below the plot, read from below; returns how far it reaches, px. */
size_t figure_add_upright(fm_chart *chart, double x_px, const char *text);
fm_interval figure_y(const fm_figure_job *at, const fm_case_row *result);
/* The paper's first value for a method at x, of the group's workload; NAN: none is printed. */
double figure_paper_value(const fm_figure_job *at, const char *method, double x);
/* The paper's points are of what the chart shows. */
bool figure_has_paper(const fm_figure_job *at);
void figure_title_quantity(char title[128], const fm_name_list *metrics);
/* "y / that of ratio_to's method" */
void figure_title_ratio(char title[128], const fm_figure_job *at);
/* Cases that differ in what x is, an option perhaps, are points of one series, which the first of
 * them starts. Numbers are of the group's cases. */
bool figure_is_same_series(const fm_figure_job *at, size_t a, size_t b);
bool figure_starts_series(const fm_figure_job *at, size_t i);
/* The case that ratios at x are taken to; NULL: it was not measured there. */
const fm_case_row *figure_base_at(const fm_figure_job *at, double x);

/* FM_UNSUPPORTED: nothing to draw. xs: room for one of each case. reference: the same of another
 * machine, drawn thin; its group is NULL where there is none. */
fm_status figure_make_lines(fm_figure_job *at, const fm_figure_job *reference, double *xs,
                            fm_error *err);
fm_status figure_make_bars(fm_figure_job *at, double *xs, fm_error *err);
fm_status figure_make_tornado(fm_figure_job *at, fm_error *err);

#endif
