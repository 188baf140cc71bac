#include "speed_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More points than POINTS_MOST are a cloud: the frontier alone is drawn, and the chart says so. */
enum { LABEL_PX = 10, LABELS_MOST = 400, POINTS_MOST = 1000 };
static const double plot_width_px = 620, plot_height_px = 400;
static const double marker_least_px = 8, marker_most_px = 19;
static const fm_colour frontier_grey = { 205, 205, 205 };

static double error_of(const fm_case_row *result)
{
    return result->metric[FM_METRIC_TOTAL_RMSE] <= FM_EXACT_RMSE
               ? 0.0
               : result->metric[FM_METRIC_TOTAL_RMSE];
}

static bool has_point(const fm_case_row *result)
{
    return result->is_measured && !result->is_simulated &&
           isfinite(result->metric[FM_METRIC_TOTAL_RMSE]);
}

static bool is_candidate(const fm_case_row *result)
{
    return result->is_ok && has_point(result) && !result->look.is_control;
}

/* A case that may be on the frontier. */
typedef struct candidate {
    double ms, error;
    size_t index; /* in the group */
} candidate;

static int compare_candidates(const void *a, const void *b)
{
    const candidate *x = a, *y = b;
    const int order = (x->ms > y->ms) - (x->ms < y->ms);
    return order != 0 ? order : (x->error > y->error) - (x->error < y->error);
}

/* From the fastest on, who has less error than all before; and who is as good as the last such. */
bool speed_error_frontier(bool *on, const fm_group *group)
{
    size_t count = 0;
    candidate best = { .error = INFINITY };
    candidate *sorted = calloc(group->count + 1, sizeof *sorted);
    if (sorted == NULL)
        return false;
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *one = group->cases[i];
        on[i] = false;
        if (is_candidate(one))
            sorted[count++] = (candidate){ one->metric[FM_METRIC_FRAME_MS], error_of(one), i };
    }
    qsort(sorted, count, sizeof *sorted, compare_candidates);
    for (size_t i = 0; i < count; i++) {
        const bool is_equal = sorted[i].error == best.error && sorted[i].ms == best.ms;
        on[sorted[i].index] = is_equal || sorted[i].error < best.error;
        if (sorted[i].error < best.error)
            best = sorted[i];
    }
    free(sorted);
    return true;
}

static int compare_points(const void *a, const void *b)
{
    const fm_point *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* Stairs: between two points of the frontier the earlier one is the best there is. */
static void make_stairs(fm_chart *chart, fm_series *series)
{
    const size_t count = series->point_count;
    qsort(series->points, count, sizeof series->points[0], compare_points);
    for (size_t i = 1; i < count; i++) /* room for a step before each but the first */
        chart_add_point(chart, series, &(fm_point){ 0 });
    for (size_t i = count; i-- > 1 && !chart->failed;) {
        series->points[2 * i] = series->points[i];
        series->points[2 * i - 1] = series->points[i];
        series->points[2 * i - 1].y = series->points[i - 1].y;
    }
}

static void add_frontier(fm_chart *chart, const fm_group *group, const bool *on)
{
    fm_series *series = chart_add_series(chart);
    if (series == NULL)
        return;
    for (size_t i = 0; i < group->count; i++)
        if (on[i])
            chart_add_point(chart, series,
                            &(fm_point){ .x = error_of(group->cases[i]),
                                         .y = group->cases[i]->metric[FM_METRIC_FRAME_MS],
                                         .low = NAN,
                                         .high = NAN });
    if (series->point_count < 2) {
        series->point_count = 0;
        return;
    }
    make_stairs(chart, series);
    series->colour = frontier_grey;
    series->stroke = FM_STROKE_SOLID;
    series->width_px = 5;
    snprintf(series->label, sizeof series->label, "Pareto frontier");
}

static double marker_px(const fm_case_row *result, double bytes_most)
{
    if (!(result->metric[FM_METRIC_BYTES_ALLOCATED] > 0.0) || !(bytes_most > 0.0))
        return marker_least_px;
    return marker_least_px + (marker_most_px - marker_least_px) *
                                 sqrt(result->metric[FM_METRIC_BYTES_ALLOCATED] / bytes_most);
}

/* What the points of a chart share. */
typedef struct look_of_points {
    double bytes_most; /* of any case */
    const bool *shown; /* [group->count]: the cases that have a point; NULL: all */
} look_of_points;

/* The points of one method with one status: solid when ok, hollow when not. */
static void add_method(fm_chart *chart, const fm_group *group, size_t first, bool is_ok,
                       const look_of_points *look)
{
    const fm_case_row *one = group->cases[first];
    fm_series *series = chart_add_series(chart);
    if (series == NULL)
        return;
    char title[96];
    group_series_title(title, one, NULL);
    for (size_t i = first; i < group->count && group_same_series(group->cases[i], one); i++) {
        const fm_case_row *result = group->cases[i];
        if (has_point(result) && result->is_ok == is_ok && (look->shown == NULL || look->shown[i]))
            chart_add_point(chart, series,
                            &(fm_point){
                                .x = error_of(result),
                                .y = result->metric[FM_METRIC_FRAME_MS],
                                .low = result->low[FM_METRIC_FRAME_MS],
                                .high = result->high[FM_METRIC_FRAME_MS],
                                .size_px = marker_px(result, look->bytes_most),
                            });
    }
    if (series->point_count == 0)
        return;
    snprintf(series->label, sizeof series->label, "%.76s%s", title, is_ok ? "" : " (wrong image)");
    series->colour = look_family_colour(one->look.family);
    series->marker = one->look.marker;
    series->has_marker = true;
    series->hollow = !is_ok;
    series->stroke = !is_ok                ? FM_STROKE_NONE
                     : one->look.is_dashed ? FM_STROKE_DASHED
                                           : FM_STROKE_SOLID;
    series->width_px = 1.1;
}

typedef struct box {
    double x0, y0, x1, y1;
} box;

static bool boxes_touch(const box *a, const box *b)
{
    return a->x0 < b->x1 && b->x0 < a->x1 && a->y0 < b->y1 && b->y0 < a->y1;
}

/* Where texts and markers are, so that no text covers another or a marker. */
typedef struct taken_boxes {
    box *boxes; /* room for two of each case */
    size_t count;
} taken_boxes;

static box marker_box(const fm_chart *chart, const fm_case_row *result, double bytes_most)
{
    double half = marker_px(result, bytes_most) / 2;
    double x = axis_position(&chart->x, error_of(result));
    double y = axis_position(&chart->y, result->metric[FM_METRIC_FRAME_MS]);
    return (box){ x - half, y - half, x + half, y + half };
}

static bool is_free(const fm_chart *chart, const taken_boxes *taken, const box *here)
{
    bool is_inside = here->x0 > 2 && here->y0 > 2 && here->x1 < chart->x.length_px - 2 &&
                     here->y1 < chart->y.length_px - 2;
    for (size_t i = 0; i < taken->count && is_inside; i++)
        if (boxes_touch(here, &taken->boxes[i]))
            return false;
    return is_inside;
}

/* "k=8" beside a marker, at the first place that is free; else nowhere. Above right comes first:
 * the frontier leaves a marker to the right, intervals leave it up and down. */
static void add_label(fm_chart *chart, taken_boxes *taken, const box *marker, const char *text)
{
    double width = chart_text_width_px(text, LABEL_PX), gap = 3;
    double x = (marker->x0 + marker->x1) / 2, y = (marker->y0 + marker->y1) / 2;
    const double places[][2] = {
        { marker->x1 + gap, marker->y1 - 2 },
        { marker->x1 + gap, y - 4 },
        { marker->x0 - gap - width, y - 4 },
        { x - width / 2, marker->y1 + gap },
        { x - width / 2, marker->y0 - gap - LABEL_PX + 1 },
    };
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        box here = { places[i][0], places[i][1], places[i][0] + width, places[i][1] + LABEL_PX };
        fm_label *label = is_free(chart, taken, &here) ? chart_add_label(chart) : NULL;
        if (label == NULL)
            continue;
        *label = (fm_label){ .x_px = here.x0, .y_px = here.y0, .size_px = LABEL_PX };
        snprintf(label->text, sizeof label->text, "%s", text);
        taken->boxes[taken->count++] = here;
        return;
    }
}

static void add_labels(fm_chart *chart, const fm_group *group, box *boxes, double bytes_most)
{
    taken_boxes taken = { .boxes = boxes };
    if (group->count > LABELS_MOST) /* there is no room for them */
        return;
    for (size_t i = 0; i < group->count; i++)
        if (has_point(group->cases[i]))
            taken.boxes[taken.count++] = marker_box(chart, group->cases[i], bytes_most);
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *result = group->cases[i];
        if (!has_point(result) || !group_uses_k(group, result))
            continue;
        char text[24];
        box marker = marker_box(chart, result, bytes_most);
        snprintf(text, sizeof text, "k=%.0f", result->k);
        add_label(chart, &taken, &marker, text);
    }
}

/* Axes from what will be drawn; returns how many points there are. */
static size_t fit_axes(fm_chart *chart, const fm_group *group, double *values)
{
    size_t points = 0, times = 0;
    for (size_t i = 0; i < group->count; i++)
        if (has_point(group->cases[i]))
            values[points++] = error_of(group->cases[i]);
    chart->x = (fm_axis){ .title = "error: RMSE against the picture of all fragments",
                          .scale = FM_SCALE_LOG,
                          .zero_below = FM_EXACT_RMSE,
                          .length_px = plot_width_px };
    axis_fit(&chart->x, values, points);
    for (size_t i = 0; i < group->count; i++)
        if (has_point(group->cases[i])) {
            values[times++] = group->cases[i]->metric[FM_METRIC_FRAME_MS];
            values[times++] = group->cases[i]->low[FM_METRIC_FRAME_MS];
            values[times++] = group->cases[i]->high[FM_METRIC_FRAME_MS];
        }
    chart->y =
        (fm_axis){ .title = "frame time [ms]", .scale = FM_SCALE_LOG, .length_px = plot_height_px };
    axis_fit(&chart->y, values, times);
    return points;
}

static double most_bytes(const fm_group *group)
{
    double most = 0.0;
    for (size_t i = 0; i < group->count; i++)
        if (has_point(group->cases[i]) && group->cases[i]->metric[FM_METRIC_BYTES_ALLOCATED] > most)
            most = group->cases[i]->metric[FM_METRIC_BYTES_ALLOCATED];
    return most;
}

fm_status speed_error_chart(fm_chart *chart, const fm_group *group, fm_error *err)
{
    fm_status status = FM_OK;
    *chart = (fm_chart){ 0 };
    double bytes_most = most_bytes(group);
    double *values = calloc(3 * group->count + 1, sizeof *values);
    bool *on = calloc(group->count + 1, sizeof *on);
    box *taken = calloc(2 * group->count + 1, sizeof *taken);
    if (values == NULL || on == NULL || taken == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "chart of %s", group->title);
        goto out;
    }
    const size_t points = fit_axes(chart, group, values);
    if (!speed_error_frontier(on, group)) {
        status = fm_fail(err, FM_NO_MEMORY, "chart of %s", group->title);
        goto out;
    }
    if (points == 0) {
        status = fm_fail(err, FM_UNSUPPORTED, "%s: no case has a time and an error", group->title);
        goto out;
    }
    snprintf(chart->title, sizeof chart->title, "Speed against error: %.120s", group->title);
    const look_of_points look = { bytes_most, points > POINTS_MOST ? on : NULL };
    if (look.shown == NULL)
        snprintf(chart->subtitle, sizeof chart->subtitle, "%s", group->workload);
    else
        snprintf(chart->subtitle, sizeof chart->subtitle,
                 "%.120s; of %zu cases, only those on the frontier are drawn", group->workload,
                 points);
    add_frontier(chart, group, on);
    for (size_t i = 0; i < group->count; i++) {
        if (i > 0 && group_same_series(group->cases[i - 1], group->cases[i]))
            continue;
        add_method(chart, group, i, true, &look);
        add_method(chart, group, i, false, &look);
    }
    add_labels(chart, group, taken, bytes_most);
    snprintf(chart->notes[0], sizeof chart->notes[0], "lower left is better");
    snprintf(chart->notes[1], sizeof chart->notes[1], "bars: 95 %% intervals");
    snprintf(chart->notes[2], sizeof chart->notes[2], "marker area: memory,");
    snprintf(chart->notes[3], sizeof chart->notes[3], "the largest is %.4g MiB",
             bytes_most / 1048576.0);
out:
    free(values);
    free(on);
    free(taken);
    return status;
}
