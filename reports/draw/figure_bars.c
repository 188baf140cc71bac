#include "figure_bars.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_labels.h"
#include "figure_paper.h"
#include "model/family.h"
#include "read/case_metrics.h"

typedef struct bar_place {
    double slot;                  /* of the next bar, in slots from the left */
    size_t top_row;               /* widest text below a bar, px */
    fm_series *intervals, *paper; /* grouped bars */
} bar_place;

static const double slot_px = 24;

static void add_upright(fm_chart *chart, bar_place *place, const fm_case_row *result)
{
    char title[96];
    group_series_title(title, result, NULL);
    const size_t width = figure_add_upright(chart, (place->slot + 0.5) * slot_px, title);
    if (width > place->top_row)
        place->top_row = width;
}

static double add_stack(fm_figure_job *job, bar_place *place, const fm_case_row *result)
{
    double top = 0.0;
    for (size_t i = 0; i <= job->from->parts.count; i++) {
        double value = i < job->from->parts.count
                           ? case_metric(job->results, result, job->from->parts.items[i])
                           : result->metric[FM_METRIC_FRAME_MS] -
                                 top; /* own passes, and what medians of parts leave */
        if (!isfinite(value) || value <= (i < job->from->parts.count ? 0.0 : 0.02 * top))
            continue;
        fm_bar *bar = chart_add_bar(job->chart);
        if (bar == NULL)
            return top;
        *bar = (fm_bar){ .x0 = place->slot + 0.1,
                         .x1 = place->slot + 0.9,
                         .y0 = top,
                         .y1 = top + value,
                         .colour = look_part_colour(i) };
        top += value;
    }
    return top;
}

/* One bar in the colour of the method's family. */
static double add_single(fm_figure_job *job, const bar_place *place, const fm_case_row *result)
{
    const fm_interval value = figure_y(job, result);
    fm_bar *bar = isfinite(value.median) ? chart_add_bar(job->chart) : NULL;
    if (bar == NULL)
        return NAN;
    *bar = (fm_bar){ .x0 = place->slot + 0.1,
                     .x1 = place->slot + 0.9,
                     .y1 = value.median,
                     .colour = look_family_colour(result->look.family) };
    return value.median;
}

static void add_cluster_title(fm_figure_job *job, double from, double to, const char *text)
{
    fm_label *label = chart_add_label(job->chart);
    if (label == NULL)
        return;
    *label = (fm_label){ .x_px = (from + to) / 2 * slot_px,
                         .y_px = 0, /* set when the longest name below the bars is known */
                         .size_px = figure_is_by_scene(job) ? 9 : 12, /* names are long */
                         .anchor = FM_ANCHOR_MIDDLE };
    snprintf(label->text, sizeof label->text, "%s", text);
}

static bool is_grouped(const fm_figure_job *job)
{
    return job->from->kind == FM_FIGURE_GROUPED_BARS;
}

/* Over a bar: its interval, and the paper's value as a hollow mark. */
static void add_marks(fm_figure_job *job, const bar_place *place, const fm_case_row *result,
                      double x)
{
    const fm_interval value = figure_y(job, result);
    const double middle = place->slot + 0.5;
    if (!is_grouped(job))
        return;
    const fm_point ours = { .x = middle, .y = value.median, .low = value.low, .high = value.high };
    chart_add_point(job->chart, place->intervals, &ours);
    const double paper = figure_has_paper(job) ? figure_paper_value(job, result->method, x) : NAN;
    if (!isfinite(paper))
        return;
    const fm_point printed = { .x = middle, .y = paper, .low = NAN, .high = NAN };
    chart_add_point(job->chart, place->paper, &printed);
    figure_note_y(job, paper);
}

/* The bars of all cases at x, or with `level` of those that do not use x. */
static void add_cluster(fm_figure_job *job, bar_place *place, double x, bool level)
{
    char text[64];
    double from = place->slot;
    for (size_t i = 0; i < job->group->count; i++) {
        const fm_case_row *result = job->group->cases[i];
        if (!result->is_measured || figure_is_level(job, result) != level ||
            (!level && figure_x(job, result) != x))
            continue;
        figure_note_y(job, is_grouped(job) ? add_single(job, place, result)
                                           : add_stack(job, place, result));
        add_marks(job, place, result, x);
        add_upright(job->chart, place, result);
        place->slot += 1.0;
    }
    if (place->slot == from)
        return;
    if (level)
        snprintf(text, sizeof text, "any %.32s", job->from->x);
    else if (figure_is_by_scene(job))
        snprintf(text, sizeof text, "%.60s", figure_scene_name(job, (size_t)x));
    else
        snprintf(text, sizeof text, "%.32s = %.6g", job->from->x, x);
    add_cluster_title(job, from, place->slot, text);
    place->slot += 1.0;
}

static void add_part_keys(fm_figure_job *job)
{
    for (size_t i = job->from->parts.count + 1; i-- > 0;) {
        bool is_used = false;
        fm_colour colour = look_part_colour(i);
        for (size_t j = 0; j < job->chart->bar_count && !is_used; j++)
            is_used = memcmp(&job->chart->bars[j].colour, &colour, sizeof colour) == 0;
        fm_series *key = is_used ? chart_add_series(job->chart) : NULL;
        if (key == NULL)
            continue;
        key->colour = colour;
        key->swatch = true;
        if (i == job->from->parts.count) {
            snprintf(key->label, sizeof key->label, "rest of the frame");
            continue;
        }
        const char *name = job->from->parts.items[i];
        snprintf(key->label, sizeof key->label, "%.*s", (int)strcspn(name, "_"), name);
    }
}

static bool has_times(const fm_figure_job *job)
{
    return metric_is_time(job->from->parts.items[0]);
}

static bool open_marks(bar_place *place, fm_figure_job *job)
{
    /* Both at once: adding a series may move the ones before. */
    for (int i = 0; i < 2; i++)
        if (chart_add_series(job->chart) == NULL)
            return false;
    place->intervals = &job->chart->series[job->chart->series_count - 2];
    place->paper = &job->chart->series[job->chart->series_count - 1];
    place->paper->has_marker = place->paper->hollow = true;
    place->paper->marker = FM_MARKER_DIAMOND;
    return true;
}

/* The keys of families in use, and bars that stand on the low end of the axis. */
static void finish_groups(fm_figure_job *job, const bar_place *place)
{
    fm_chart *chart = job->chart;
    for (size_t i = 0; i < chart->bar_count; i++)
        chart->bars[i].y0 = chart->y.low;
    if (place->paper != NULL && place->paper->point_count > 0)
        snprintf(place->paper->label, sizeof place->paper->label, "paper");
    for (int family = 0; family < FM_FAMILY_COUNT; family++) {
        const fm_colour colour = look_family_colour((fm_family)family);
        bool is_used = false;
        for (size_t i = 0; i < chart->bar_count && !is_used; i++)
            is_used = memcmp(&chart->bars[i].colour, &colour, sizeof colour) == 0;
        fm_series *key = is_used ? chart_add_series(chart) : NULL;
        if (key == NULL)
            continue;
        key->colour = colour;
        key->swatch = true;
        snprintf(key->label, sizeof key->label, "%s", family_name((fm_family)family));
    }
}

static void fit_axes(fm_figure_job *job, const bar_place *place)
{
    fm_chart *chart = job->chart;
    chart->y.scale = job->from->is_log ? FM_SCALE_LOG : FM_SCALE_LINEAR;
    axis_fit(&chart->y, job->y.items, job->y.count);
    if (is_grouped(job))
        figure_title_quantity(chart->y.title, &job->from->ys);
    else
        snprintf(chart->y.title, sizeof chart->y.title, "%s", has_times(job) ? "time [ms]" : "sum");
    chart->x.low = 0.0;
    chart->x.high = place->slot - 0.5;
    chart->x.length_px = chart->x.high * slot_px;
    for (size_t i = 0; i < chart->label_count; i++)
        if (!chart->labels[i].upright)
            chart->labels[i].y_px = -(double)place->top_row - 28;
    chart->bottom_px = (int)place->top_row + 44;
}

fm_status figure_make_bars(fm_figure_job *job, fm_error *err)
{
    bar_place place = { .slot = 0.5 };
    figure_find_places(job);
    if (is_grouped(job) && !open_marks(&place, job))
        return fm_fail(err, FM_NO_MEMORY, "%s: bars", job->group->title);
    for (size_t i = 0; i < job->places.count; i++)
        add_cluster(job, &place, job->places.items[i], false);
    add_cluster(job, &place, NAN, true);
    if (job->y.count == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case was measured", job->group->title);
    fit_axes(job, &place);
    if (is_grouped(job))
        finish_groups(job, &place);
    else
        add_part_keys(job);
    return FM_OK;
}
