#include "figure_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* stacked-bars: a cluster for each x, and one for the cases that do not use it. */
typedef struct bar_place {
    double slot;    /* of the next bar, in slots from the left */
    size_t top_row; /* widest text below a bar, px */
} bar_place;

static const double slot_px = 24;

static void add_upright(fm_chart *chart, bar_place *place, const fm_case_row *result)
{
    fm_label *label = chart_add_label(chart);
    if (label == NULL)
        return;
    char title[96];
    group_series_title(title, result);
    *label = (fm_label){ .x_px = (place->slot + 0.5) * slot_px + 4,
                         .y_px = -7,
                         .anchor = FM_ANCHOR_END,
                         .upright = true };
    snprintf(label->text, sizeof label->text, "%.63s", title);
    size_t width = (size_t)chart_text_width_px(label->text, 11);
    label->y_px = -7;
    if (width > place->top_row)
        place->top_row = width;
}

static double add_stack(fm_figure_job *at, bar_place *place, const fm_case_row *result)
{
    double top = 0.0;
    for (size_t i = 0; i <= at->from->parts.count; i++) {
        double value =
            i < at->from->parts.count
                ? result_files_metric(at->results, result, at->from->parts.names[i])
                : result->frame_ms - top; /* own passes, and what medians of parts leave */
        if (!isfinite(value) || value <= (i < at->from->parts.count ? 0.0 : 0.02 * top))
            continue;
        fm_bar *bar = chart_add_bar(at->chart);
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

static void add_cluster_title(fm_figure_job *at, double from, double to, const char *text)
{
    fm_label *label = chart_add_label(at->chart);
    if (label == NULL)
        return;
    *label = (fm_label){ .x_px = (from + to) / 2 * slot_px,
                         .y_px = 0, /* set when the longest name below the bars is known */
                         .size_px = 12,
                         .anchor = FM_ANCHOR_MIDDLE };
    snprintf(label->text, sizeof label->text, "%s", text);
}

/* The bars of all cases at x, or with `level` of those that do not use x. */
static void add_cluster(fm_figure_job *at, bar_place *place, double x, bool level)
{
    char text[64];
    double from = place->slot;
    for (size_t i = 0; i < at->group->count; i++) {
        const fm_case_row *result = at->group->cases[i];
        if (!result->is_measured || figure_is_level(at, result) != level ||
            (!level && figure_x(at, result) != x))
            continue;
        at->y[at->y_count++] = add_stack(at, place, result);
        add_upright(at->chart, place, result);
        place->slot += 1.0;
    }
    if (place->slot == from)
        return;
    if (level)
        snprintf(text, sizeof text, "any %.32s", at->from->x);
    else if (figure_is_by_scene(at))
        snprintf(text, sizeof text, "%.60s", at->figure->scenes.names[(size_t)x - 1]);
    else
        snprintf(text, sizeof text, "%.32s = %.6g", at->from->x, x);
    add_cluster_title(at, from, place->slot, text);
    place->slot += 1.0;
}

static void add_part_keys(fm_figure_job *at)
{
    for (size_t i = at->from->parts.count + 1; i-- > 0;) {
        bool is_used = false;
        fm_colour colour = look_part_colour(i);
        for (size_t j = 0; j < at->chart->bar_count && !is_used; j++)
            is_used = memcmp(&at->chart->bars[j].colour, &colour, sizeof colour) == 0;
        fm_series *key = is_used ? chart_add_series(at->chart, 0) : NULL;
        if (key == NULL)
            continue;
        key->colour = colour;
        key->swatch = true;
        if (i == at->from->parts.count) {
            snprintf(key->label, sizeof key->label, "rest of the frame");
            continue;
        }
        const char *name = at->from->parts.names[i];
        snprintf(key->label, sizeof key->label, "%.*s", (int)strcspn(name, "_"), name);
    }
}

static bool has_times(const fm_figure_job *at)
{
    const char *first = at->from->parts.names[0];
    const size_t length = strlen(first);
    return length > 3 && strcmp(first + length - 3, "_ms") == 0;
}

fm_status figure_make_bars(fm_figure_job *at, double *xs, fm_error *err)
{
    fm_chart *chart = at->chart;
    bar_place place = { .slot = 0.5 };
    size_t x_count = figure_distinct_x(xs, at);
    for (size_t i = 0; i < x_count; i++)
        add_cluster(at, &place, xs[i], false);
    add_cluster(at, &place, NAN, true);
    if (at->y_count == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case was measured", at->group->title);
    axis_fit(&chart->y, at->y, at->y_count);
    snprintf(chart->y.title, sizeof chart->y.title, "%s", has_times(at) ? "time [ms]" : "sum");
    chart->x.low = 0.0;
    chart->x.high = place.slot - 0.5;
    chart->x.length_px = chart->x.high * slot_px;
    for (size_t i = 0; i < chart->label_count; i++)
        if (!chart->labels[i].upright)
            chart->labels[i].y_px = -(double)place.top_row - 28;
    chart->bottom_px = (int)place.top_row + 44;
    add_part_keys(at);
    return FM_OK;
}
