#include "figure_lines.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_labels.h"
#include "figure_paper.h"
#include "read/interval.h"
#include "read/options.h"

/* The value to draw at x, as a ratio where the chart wants one; false: none. */
static bool value_at(fm_point *point, const fm_figure_job *job, const fm_case_row *result, double x)
{
    fm_interval y = figure_y(job, result);
    if (job->from->ratio_to != NULL) {
        const fm_case_row *base = figure_base_at(job, x);
        if (base == NULL)
            return false;
        y = interval_ratio(y, figure_y(job, base));
        if (base == result)
            y.low = y.high = y.median;
    }
    const bool has_interval = y.high > y.low;
    *point = (fm_point){ .x = x,
                         .y = y.median,
                         .low = has_interval ? y.low : NAN,
                         .high = has_interval ? y.high : NAN };
    return isfinite(point->y) && isfinite(x) && !(job->from->is_log && point->y <= 0.0);
}

/* A method without a k joins the workloads of others that differ in it. */
static bool has_other_k(const fm_figure_job *job, const fm_case_row *one)
{
    bool differs = false;
    for (size_t i = 0; i < job->group->count && !text_list_has(&job->from->free_columns, "k");
         i++) {
        const fm_case_row *other = job->group->cases[i];
        differs |= strcmp(other->method, one->method) == 0 && other->k != one->k;
    }
    return differs && !isnan(one->k);
}

static void label_ours(fm_series *series, const fm_figure_job *job, const fm_case_row *one)
{
    char title[96], k[24] = "";
    if (series->point_count == 0)
        return;
    group_series_title(title, one, &job->from->free_columns);
    if (has_other_k(job, one))
        snprintf(k, sizeof k, ", k = %.0f", one->k);
    snprintf(series->label, sizeof series->label, "%.56s%s%s", title, k,
             one->is_ok ? "" : " (wrong image)");
}

/* One measurement drawn across all x: markers at the ends, one interval. */
static void level_line(fm_series *series)
{
    if (series->point_count < 2)
        return;
    series->points[1] = series->points[series->point_count - 1];
    series->points[1].low = series->points[1].high = NAN;
    series->point_count = 2;
}

static int compare_x(const void *left, const void *right)
{
    const fm_point *a = left, *b = right;
    return (a->x > b->x) - (a->x < b->x);
}

/* Series of one method with other options: darker, other markers, and every second one dashed. */
static void tell_variants_apart(fm_series *series, const fm_figure_job *job, size_t first)
{
    const fm_group *group = job->group;
    size_t variant = 0;
    for (size_t i = 0; i < first; i++)
        variant += strcmp(group->cases[i]->method, group->cases[first]->method) == 0 &&
                   figure_starts_series(job, i);
    series->marker = (fm_marker)(((size_t)series->marker + variant) % FM_MARKER_COUNT);
    series->colour = look_shade(series->colour, variant);
    if (variant % 2 == 1)
        series->stroke = series->stroke == FM_STROKE_SOLID ? FM_STROKE_DASHED : FM_STROKE_SOLID;
}

/* The points of one case: at its own x, or level at all of the chart's. */
static void add_points(const fm_figure_job *job, fm_figure_job *axes, fm_series *series,
                       const fm_case_row *result)
{
    const bool is_level = figure_is_level(job, result);
    const size_t count = is_level ? axes->places.count : 1;
    for (size_t i = 0; result->is_measured && i < count; i++) {
        fm_point point;
        const double x = is_level ? axes->places.items[i] : figure_x(job, result);
        if (!value_at(&point, job, result, x))
            continue;
        chart_add_point(job->chart, series, &point);
        figure_note_point(axes, &point);
    }
}

/* The series that starts at case `first`. `axes` has the chart's places, and notes what the axes
 * must hold. */
static fm_series *add_series(const fm_figure_job *job, fm_figure_job *axes, size_t first)
{
    const fm_case_row *one = job->group->cases[first];
    fm_series *series = chart_add_series(job->chart);
    if (series == NULL)
        return NULL;
    figure_style_series(series, &one->look);
    tell_variants_apart(series, job, first);
    for (size_t i = first; i < job->group->count; i++)
        if (figure_is_same_series(job, first, i))
            add_points(job, axes, series, job->group->cases[i]);
    if (series->point_count > 1)
        qsort(series->points, series->point_count, sizeof *series->points, compare_x);
    if (figure_is_level(job, one) && job->from->ratio_to == NULL)
        level_line(series);
    return series;
}

static void add_ours(fm_figure_job *job)
{
    for (size_t i = 0; i < job->group->count; i++) {
        fm_series *series = figure_starts_series(job, i) ? add_series(job, job, i) : NULL;
        if (series != NULL)
            label_ours(series, job, job->group->cases[i]);
    }
}

/* Another machine's curves: thin, without markers, colours as ours and therefore without legend. */
static void add_reference(fm_figure_job *job, const fm_figure_job *reference)
{
    for (size_t i = 0; reference->group != NULL && i < reference->group->count; i++) {
        fm_series *series =
            figure_starts_series(reference, i) ? add_series(reference, job, i) : NULL;
        if (series == NULL)
            continue;
        series->has_marker = false;
        series->width_px = 0.8;
        for (size_t j = 0; j < series->point_count; j++)
            series->points[j].low = series->points[j].high = NAN;
    }
}

static void title_axes(fm_figure_job *job)
{
    figure_title_column(job->chart->x.title, job->from->x);
    if (job->from->ratio_to == NULL)
        figure_title_quantity(job->chart->y.title, &job->from->ys);
    else
        figure_title_ratio(job->chart->y.title, job);
}

static void fit_numbers(fm_figure_job *job)
{
    fm_axis *x = &job->chart->x;
    x->scale = FM_SCALE_LOG;
    for (size_t i = 0; i < job->x.count; i++)
        if (job->x.items[i] <= 0.0)
            x->scale = FM_SCALE_LINEAR;
    axis_fit(x, job->x.items, job->x.count);
    axis_tick_values(x, job->x.items, job->x.count);
}

/* Ticks without numbers, and the scenes' names below them, in place of a title. */
static void name_scenes(fm_figure_job *job)
{
    fm_axis *x = &job->chart->x;
    size_t widest = 0;
    x->scale = FM_SCALE_LINEAR;
    x->low = 0.5;
    x->high = (double)job->figure->scenes.count + 0.5;
    x->title[0] = '\0';
    for (size_t place = 1; place <= job->figure->scenes.count; place++) {
        const size_t width = figure_add_upright(job->chart, axis_position(x, (double)place),
                                                figure_scene_name(job, place));
        widest = width > widest ? width : widest;
        if (x->tick_count < FM_AXIS_TICKS)
            x->ticks[x->tick_count++] = (fm_tick){ .value = (double)place };
    }
    job->chart->bottom_px = (int)widest + 24;
}

static void add_notes(fm_chart *chart, bool has_paper, const fm_group *reference)
{
    size_t note = 0;
    snprintf(chart->notes[note++], sizeof chart->notes[0], "bars: 95 %% intervals");
    if (has_paper)
        snprintf(chart->notes[note++], sizeof chart->notes[0], "hollow: the paper");
    if (reference != NULL)
        snprintf(chart->notes[note++], sizeof chart->notes[0], "thin: %.50s",
                 reference->cases[0]->device_name);
}

fm_status figure_make_lines(fm_figure_job *job, const fm_figure_job *reference, fm_error *err)
{
    fm_chart *chart = job->chart;
    figure_find_places(job);
    add_ours(job);
    const size_t own_values = job->y.count;
    if (figure_has_paper(job))
        figure_add_paper(job);
    const size_t paper_values = job->y.count;
    add_reference(job, reference);
    if (own_values == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case has %s%s%s", job->group->title,
                       job->from->y, job->from->ratio_to == NULL ? "" : " and one of ",
                       job->from->ratio_to == NULL ? "" : job->from->ratio_to);
    chart->y.scale = job->from->is_log ? FM_SCALE_LOG : FM_SCALE_LINEAR;
    axis_fit(&chart->y, job->y.items, job->y.count);
    title_axes(job);
    if (figure_is_by_scene(job))
        name_scenes(job);
    else
        fit_numbers(job);
    add_notes(chart, paper_values > own_values,
              job->y.count > paper_values ? reference->group : NULL);
    return FM_OK;
}
