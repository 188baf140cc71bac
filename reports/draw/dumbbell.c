#include "dumbbell.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const double plot_width_px = 560, row_px = 18, label_gap_px = 8;
enum { LABEL_PX = 11, LABEL_MARGIN_PX = 24 };

/* Of Okabe and Ito's colours, which families have, too: no family is drawn here. */
static const fm_colour verdict_colours[] = {
    [FM_COMPARED_SLOWER] = { 213, 94, 0 },     [FM_COMPARED_UNCLEAR] = { 150, 150, 150 },
    [FM_COMPARED_SAME] = { 86, 180, 233 },     [FM_COMPARED_FASTER] = { 0, 158, 115 },
    [FM_COMPARED_UNTIMED] = { 150, 150, 150 },
};

/* The cases that are drawn, top to bottom. */
typedef struct rows {
    const fm_compared *cases[FM_DUMBBELL_CASES];
    size_t count, timed; /* drawn; that could be */
} rows;

static rows choose_rows(const fm_comparison *comparison)
{
    rows chosen = { .count = 0 };
    for (size_t i = 0; i < comparison->count; i++) {
        const fm_compared *compared = &comparison->cases[i];
        if (!(compared->base.median > 0.0 && compared->now.median > 0.0))
            continue;
        if (chosen.count < FM_DUMBBELL_CASES)
            chosen.cases[chosen.count++] = compared;
        chosen.timed++;
    }
    return chosen;
}

static double height_of(const rows *chosen, size_t row)
{
    return (double)(chosen->count - row) - 0.5;
}

static void add_point(fm_chart *chart, fm_series *series, double x, double y)
{
    chart_add_point(chart, series, &(fm_point){ .x = x, .y = y, .low = NAN, .high = NAN });
}

static void add_lines(fm_chart *chart, const rows *chosen)
{
    for (size_t i = 0; i < chosen->count; i++) {
        fm_series *line = chart_add_series(chart);
        if (line == NULL)
            return;
        line->colour = verdict_colours[chosen->cases[i]->verdict];
        line->stroke = FM_STROKE_SOLID;
        line->width_px = 2.5;
        add_point(chart, line, chosen->cases[i]->base.median, height_of(chosen, i));
        add_point(chart, line, chosen->cases[i]->now.median, height_of(chosen, i));
    }
}

static fm_series *add_markers(fm_chart *chart, const char *label, fm_colour colour)
{
    fm_series *series = chart_add_series(chart);
    if (series == NULL)
        return NULL;
    snprintf(series->label, sizeof series->label, "%s", label);
    series->colour = colour;
    series->has_marker = true;
    series->marker = FM_MARKER_CIRCLE;
    return series;
}

static void add_base(fm_chart *chart, const rows *chosen)
{
    fm_series *series = add_markers(chart, "BASE", (fm_colour){ 0, 0, 0 });
    if (series == NULL)
        return;
    series->hollow = true;
    for (size_t i = 0; i < chosen->count; i++)
        add_point(chart, series, chosen->cases[i]->base.median, height_of(chosen, i));
}

/* One series a verdict, so that the legend names it; none without a case. */
static void add_now(fm_chart *chart, const rows *chosen, fm_compared_verdict verdict)
{
    char label[32];
    fm_series *series = NULL;
    snprintf(label, sizeof label, "NEW, %s", compared_verdict_name(verdict));
    for (size_t i = 0; i < chosen->count; i++) {
        if (chosen->cases[i]->verdict != verdict)
            continue;
        if (series == NULL)
            series = add_markers(chart, label, verdict_colours[verdict]);
        if (series != NULL)
            add_point(chart, series, chosen->cases[i]->now.median, height_of(chosen, i));
    }
}

static void add_names(fm_chart *chart, const rows *chosen)
{
    for (size_t i = 0; i < chosen->count; i++) {
        char name[FM_COMPARED_NAME_BYTES];
        fm_label *label = chart_add_label(chart);
        if (label == NULL)
            return;
        *label = (fm_label){ .x_px = -label_gap_px,
                             .y_px = axis_position(&chart->y, height_of(chosen, i)) - 4,
                             .size_px = LABEL_PX,
                             .anchor = FM_ANCHOR_END };
        compared_name(name, chosen->cases[i]->pair.base);
        snprintf(label->text, sizeof label->text, "%.63s", name);
        chart->left_px =
            (int)fmax(chart->left_px, chart_text_width_px(label->text, LABEL_PX) + LABEL_MARGIN_PX);
    }
}

static void fit_axes(fm_chart *chart, const fm_comparison *comparison, const rows *chosen)
{
    double values[2 * FM_DUMBBELL_CASES];
    for (size_t i = 0; i < chosen->count; i++) {
        values[2 * i] = chosen->cases[i]->base.median;
        values[2 * i + 1] = chosen->cases[i]->now.median;
    }
    chart->x = (fm_axis){ .scale = FM_SCALE_LOG, .length_px = plot_width_px };
    quantity_title(chart->x.title, &comparison->quantity);
    axis_fit(&chart->x, values, 2 * chosen->count);
    chart->y = (fm_axis){ .low = 0.0,
                          .high = (double)chosen->count,
                          .length_px = row_px * (double)chosen->count };
}

fm_status dumbbell_chart(fm_chart *chart, const fm_comparison *comparison, fm_error *err)
{
    const rows chosen = choose_rows(comparison);
    *chart = (fm_chart){ 0 };
    if (chosen.count == 0)
        return fm_fail(err, FM_UNSUPPORTED, "no case has a time in both runs");
    fit_axes(chart, comparison, &chosen);
    add_lines(chart, &chosen);
    add_base(chart, &chosen);
    for (int i = 0; i < FM_COMPARED_UNTIMED; i++)
        add_now(chart, &chosen, (fm_compared_verdict)i);
    add_names(chart, &chosen);
    snprintf(chart->title, sizeof chart->title, "%s, BASE to NEW", chart->x.title);
    if (chosen.timed > chosen.count)
        snprintf(chart->subtitle, sizeof chart->subtitle, "the worst %zu of %zu cases",
                 chosen.count, chosen.timed);
    return FM_OK;
}
