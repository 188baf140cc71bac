#include "figure_tornado.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "figure_labels.h"
#include "read/case_metrics.h"

/* Colours of the parts of a bar, beyond those that stacks use first. */
enum { LOW_PART = 6, HIGH_PART = 7, VALUE_PX = 9 };
static const double row_px = 24, label_gap_px = 8, value_gap_px = 5;

/* A parameter's bar: the mean ratios with it at the ends of its range. */
typedef struct tornado_bar {
    const char *name;
    double low, high, length;
} tornado_bar;

/* Of one method: those parameters that it has metrics of. */
typedef struct tornado_block {
    double nominal;
    tornado_bar bars[FM_FIGURE_SWEPT];
    size_t count;
    double bottom; /* rows from the top */
    char title[96];
} tornado_block;

/* The mean of a metric over that of ratio_to, of the cases of the series that starts at `first`;
 * NAN: none has both. */
static double mean_ratio(const fm_figure_job *job, size_t first, const char *metric)
{
    double sum = 0.0;
    size_t count = 0;
    for (size_t i = first; i < job->group->count; i++) {
        const fm_case_row *result = job->group->cases[i];
        if (!figure_is_same_series(job, first, i) || !result->is_measured)
            continue;
        const fm_case_row *base = figure_base_at(job, figure_x(job, result));
        if (base == NULL)
            continue;
        const double ratio =
            case_metric(job->results, result, metric) / case_metric(job->results, base, metric);
        sum += isfinite(ratio) ? ratio : 0.0;
        count += isfinite(ratio);
    }
    return count > 0 ? sum / (double)count : NAN;
}

/* Longest first. */
static int compare_bars(const void *left, const void *right)
{
    const tornado_bar *a = left, *b = right;
    const int order = (a->length < b->length) - (a->length > b->length);
    return order != 0 ? order : strcmp(a->name, b->name);
}

/* Both ends may lie on one side of the defaults, which the bar then starts from. */
static double bar_length(const tornado_bar *bar, double nominal)
{
    return fmax(fmax(bar->low, bar->high), nominal) - fmin(fmin(bar->low, bar->high), nominal);
}

/* false: there is nothing of this method to draw. */
static bool fill_block(tornado_block *block, const fm_figure_job *job, size_t first)
{
    *block = (tornado_block){ .nominal = mean_ratio(job, first, job->from->y) };
    for (size_t i = 0; i < job->from->swept_count && isfinite(block->nominal); i++) {
        const fm_figure_swept *swept = &job->from->sweep[i];
        tornado_bar *bar = &block->bars[block->count];
        *bar = (tornado_bar){ .name = swept->name,
                              .low = mean_ratio(job, first, swept->low),
                              .high = mean_ratio(job, first, swept->high) };
        bar->length = bar_length(bar, block->nominal);
        block->count += isfinite(bar->low) && isfinite(bar->high);
    }
    qsort(block->bars, block->count, sizeof block->bars[0], compare_bars);
    group_series_title(block->title, job->group->cases[first], &job->from->free_columns);
    return block->count > 0;
}

static size_t fill_blocks(tornado_block *blocks, fm_figure_job *job)
{
    size_t count = 0;
    double row = 0.0;
    for (size_t i = 0; i < job->group->count; i++) {
        if (strcmp(job->group->cases[i]->method, job->from->ratio_to) == 0 ||
            !figure_starts_series(job, i) || !fill_block(&blocks[count], job, i))
            continue;
        row += (double)blocks[count].count + 1.0; /* its title, and its bars */
        blocks[count++].bottom = row;
    }
    return count;
}

static void fit_axes(fm_figure_job *job, const tornado_block *blocks, size_t count)
{
    double values[FM_FIGURE_SWEPT * 2 + 1], ends[2] = { INFINITY, -INFINITY };
    char ratio[128];
    for (size_t i = 0; i < count; i++) {
        size_t value_count = 0;
        values[value_count++] = blocks[i].nominal;
        for (size_t k = 0; k < blocks[i].count; k++) {
            values[value_count++] = blocks[i].bars[k].low;
            values[value_count++] = blocks[i].bars[k].high;
        }
        for (size_t k = 0; k < value_count; k++) {
            ends[0] = fmin(ends[0], values[k]);
            ends[1] = fmax(ends[1], values[k]);
        }
    }
    axis_fit_near(&job->chart->x, ends, 2);
    figure_title_ratio(ratio, job);
    snprintf(job->chart->x.title, sizeof job->chart->x.title, "%.90s, mean of all %s", ratio,
             figure_is_by_scene(job) ? "scenes" : job->from->x);
    job->chart->y.low = 0.0;
    job->chart->y.high = blocks[count - 1].bottom + 0.5;
    job->chart->y.length_px = job->chart->y.high * row_px;
}

/* Rows from the top, as a value of the axis. */
static double from_top(const fm_chart *chart, double row)
{
    return chart->y.high - row;
}

static void add_text(fm_chart *chart, double x_px, double row, fm_anchor anchor, int size_px,
                     const char *text)
{
    fm_label *label = chart_add_label(chart);
    if (label == NULL)
        return;
    *label = (fm_label){ .x_px = x_px,
                         .y_px = axis_position(&chart->y, from_top(chart, row)) - 4,
                         .size_px = size_px,
                         .anchor = anchor };
    snprintf(label->text, sizeof label->text, "%.63s", text);
    if (anchor == FM_ANCHOR_END && size_px == 0)
        chart->left_px = (int)fmax(chart->left_px, chart_text_width_px(label->text, 11) + 30);
}

static void add_value(fm_chart *chart, double value, double row, fm_anchor anchor)
{
    char text[24];
    const double side = anchor == FM_ANCHOR_END ? -1 : anchor == FM_ANCHOR_START ? 1 : 0;
    snprintf(text, sizeof text, "%.3f", value);
    add_text(chart, axis_position(&chart->x, value) + side * value_gap_px, row, anchor, VALUE_PX,
             text);
}

static void add_part(fm_chart *chart, double from, double to, double row, int part)
{
    fm_bar *bar = chart_add_bar(chart);
    if (bar != NULL)
        *bar = (fm_bar){ .x0 = fmin(from, to),
                         .x1 = fmax(from, to),
                         .y0 = from_top(chart, row + 0.38),
                         .y1 = from_top(chart, row - 0.38),
                         .colour = look_part_colour((size_t)part) };
}

/* The longer part first: the other one may lie upon it. */
static void add_bar(fm_chart *chart, const tornado_bar *bar, double nominal, double row)
{
    const bool low_first = fabs(bar->low - nominal) > fabs(bar->high - nominal);
    if (low_first)
        add_part(chart, nominal, bar->low, row, LOW_PART);
    add_part(chart, nominal, bar->high, row, HIGH_PART);
    if (!low_first)
        add_part(chart, nominal, bar->low, row, LOW_PART);
    add_text(chart, -label_gap_px, row, FM_ANCHOR_END, 0, bar->name);
    add_value(chart, fmin(bar->low, bar->high), row, FM_ANCHOR_END);
    add_value(chart, fmax(bar->low, bar->high), row, FM_ANCHOR_START);
}

static void add_block(fm_chart *chart, const tornado_block *block, bool is_first)
{
    const double top = block->bottom - (double)block->count; /* of the bars */
    fm_series *line = chart_add_series(chart);
    if (line == NULL)
        return;
    line->colour = look_family_colour(FM_FAMILY_CONTROL);
    line->stroke = FM_STROKE_SOLID;
    for (size_t i = 0; i < 2; i++)
        chart_add_point(chart, line,
                        &(fm_point){ .x = block->nominal,
                                     .y = from_top(chart, i == 0 ? block->bottom : top),
                                     .low = NAN,
                                     .high = NAN });
    if (is_first)
        snprintf(line->label, sizeof line->label, "all at their defaults");
    add_text(chart, -label_gap_px, top - 0.4, FM_ANCHOR_END, 12, block->title);
    add_value(chart, block->nominal, top - 0.4, FM_ANCHOR_MIDDLE);
    for (size_t i = 0; i < block->count; i++)
        add_bar(chart, &block->bars[i], block->nominal, top + (double)i + 0.5);
}

static void add_key(fm_chart *chart, int part, const char *text)
{
    fm_series *key = chart_add_series(chart);
    if (key == NULL)
        return;
    key->colour = look_part_colour((size_t)part);
    key->swatch = true;
    snprintf(key->label, sizeof key->label, "%s", text);
}

fm_status figure_make_tornado(fm_figure_job *job, fm_error *err)
{
    tornado_block *blocks = calloc(job->group->count + 1, sizeof *blocks);
    if (blocks == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: tornado", job->group->title);
    const size_t count = fill_blocks(blocks, job);
    if (count == 0) {
        free(blocks);
        return fm_fail(err, FM_UNSUPPORTED,
                       "%s: no case has %s, what it is swept to, and one of %s", job->group->title,
                       job->from->y, job->from->ratio_to);
    }
    fit_axes(job, blocks, count);
    for (size_t i = 0; i < count; i++)
        add_block(job->chart, &blocks[i], i == 0);
    add_key(job->chart, LOW_PART, "at its lowest");
    add_key(job->chart, HIGH_PART, "at its highest");
    if (blocks[0].count < job->from->swept_count)
        snprintf(job->chart->notes[0], sizeof job->chart->notes[0],
                 "parameters without values: %zu", job->from->swept_count - blocks[0].count);
    free(blocks);
    return FM_OK;
}
