#include "speed_error.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* More points than POINTS_MOST are a cloud: the frontier alone is drawn, and the chart says so. */
enum { LABELS_MOST = 400, POINTS_MOST = 1000 };
static const double marker_least_px = 8, marker_most_px = 19;
static const fm_colour frontier_grey = { 205, 205, 205 };

/* Of those that stand on the frontier or are tied, from the fastest median on, who has less error
 * than all before: between them the frontier goes. */
typedef struct step {
    double ms, error;
    size_t index; /* in the group */
} step;

static int compare_steps(const void *a, const void *b)
{
    const step *x = a, *y = b;
    const int order = (x->ms > y->ms) - (x->ms < y->ms);
    return order != 0 ? order : (x->error > y->error) - (x->error < y->error);
}

static int compare_points(const void *a, const void *b)
{
    const fm_point *p = a, *q = b;
    return (p->x > q->x) - (p->x < q->x);
}

/* What the points of a chart share. */
typedef struct look_of_points {
    const fm_error_kind *kind;
    const fm_place *places; /* [group->count] */
    double bytes_most;      /* of any case */
    bool is_cloud;          /* more points than POINTS_MOST: dominated ones are left out */
} look_of_points;

static bool is_shown(const fm_group *group, size_t i, const look_of_points *look)
{
    return standing_has_point(group->cases[i], look->kind) &&
           (!look->is_cloud || look->places[i].standing >= FM_STANDING_TIED);
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

static void add_frontier(fm_chart *chart, const fm_group *group, const look_of_points *look)
{
    size_t count = 0;
    double least = INFINITY;
    bool has_one_n = true;
    fm_series *series = chart_add_series(chart);
    step *steps = calloc(group->count + 1, sizeof *steps);
    if (series == NULL || steps == NULL) {
        chart->failed = true;
        free(steps);
        return;
    }
    double n = NAN;
    for (size_t i = 0; i < group->count; i++) /* cases of another n are no rivals: no line */
        if (look->places[i].standing >= FM_STANDING_TIED) {
            const double own = group->cases[i]->metric[FM_METRIC_N];
            has_one_n = has_one_n && (isnan(n) || isnan(own) || own == n);
            n = own;
            steps[count++] = (step){ group->cases[i]->metric[FM_METRIC_FRAME_MS],
                                     error_kind_of(look->kind, group->cases[i]), i };
        }
    if (!has_one_n)
        count = 0;
    qsort(steps, count, sizeof *steps, compare_steps);
    for (size_t i = 0; i < count; i++) {
        if (steps[i].error < least)
            chart_add_point(
                chart, series,
                &(fm_point){ .x = steps[i].error, .y = steps[i].ms, .low = NAN, .high = NAN });
        least = fmin(least, steps[i].error);
    }
    free(steps);
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

/* Which of a method's points make a series. */
typedef enum sort { SORT_GOOD, SORT_DOMINATED, SORT_WRONG, SORTS } sort;

static sort sort_of(const fm_case_row *result, const fm_place *place)
{
    if (!result->is_ok)
        return SORT_WRONG;
    return place->standing == FM_STANDING_DOMINATED ? SORT_DOMINATED : SORT_GOOD;
}

static void dress(fm_series *series, const fm_case_row *one, sort wanted)
{
    char title[96];
    group_series_title(title, one, NULL);
    if (wanted != SORT_DOMINATED)
        snprintf(series->label, sizeof series->label, "%.76s%s", title,
                 wanted == SORT_WRONG ? " (wrong image)" : "");
    series->colour =
        wanted == SORT_DOMINATED ? look_dominated_colour() : look_family_colour(one->look.family);
    series->marker = one->look.marker;
    series->has_marker = true;
    series->hollow = wanted == SORT_WRONG;
    series->stroke = FM_STROKE_NONE;
}

/* The points of one method and sort: grey where dominated, hollow where not ok. */
static void add_method(fm_chart *chart, const fm_group *group, size_t first, sort wanted,
                       const look_of_points *look)
{
    const fm_case_row *one = group->cases[first];
    fm_series *series = chart_add_series(chart);
    if (series == NULL)
        return;
    for (size_t i = first; i < group->count && group_same_series(group->cases[i], one); i++) {
        const fm_case_row *result = group->cases[i];
        if (is_shown(group, i, look) && sort_of(result, &look->places[i]) == wanted)
            chart_add_point(chart, series,
                            &(fm_point){
                                .x = error_kind_of(look->kind, result),
                                .y = result->metric[FM_METRIC_FRAME_MS],
                                .low = result->low[FM_METRIC_FRAME_MS],
                                .high = result->high[FM_METRIC_FRAME_MS],
                                .size_px = marker_px(result, look->bytes_most),
                            });
    }
    if (series->point_count > 0)
        dress(series, one, wanted);
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

static box marker_box(const fm_chart *chart, const fm_case_row *result, const look_of_points *look)
{
    double half = marker_px(result, look->bytes_most) / 2;
    double x = axis_position(&chart->x, error_kind_of(look->kind, result));
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
    double width = chart_text_width_px(text, SPEED_ERROR_LABEL_PX), gap = 3;
    double x = (marker->x0 + marker->x1) / 2, y = (marker->y0 + marker->y1) / 2;
    const double places[][2] = {
        { marker->x1 + gap, marker->y1 - 2 },
        { marker->x1 + gap, y - 4 },
        { marker->x0 - gap - width, y - 4 },
        { x - width / 2, marker->y1 + gap },
        { x - width / 2, marker->y0 - gap - SPEED_ERROR_LABEL_PX + 1 },
    };
    for (size_t i = 0; i < sizeof places / sizeof places[0]; i++) {
        box here = { places[i][0], places[i][1], places[i][0] + width,
                     places[i][1] + SPEED_ERROR_LABEL_PX };
        fm_label *label = is_free(chart, taken, &here) ? chart_add_label(chart) : NULL;
        if (label == NULL)
            continue;
        *label = (fm_label){ .x_px = here.x0, .y_px = here.y0, .size_px = SPEED_ERROR_LABEL_PX };
        snprintf(label->text, sizeof label->text, "%s", text);
        taken->boxes[taken->count++] = here;
        return;
    }
}

/* Of what is grey there is no label. */
static void add_labels(fm_chart *chart, const fm_group *group, box *boxes,
                       const look_of_points *look)
{
    taken_boxes taken = { .boxes = boxes };
    if (group->count > LABELS_MOST) /* there is no room for them */
        return;
    for (size_t i = 0; i < group->count; i++)
        if (is_shown(group, i, look))
            taken.boxes[taken.count++] = marker_box(chart, group->cases[i], look);
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *result = group->cases[i];
        if (!is_shown(group, i, look) || !group_uses_k(group, result) ||
            look->places[i].standing == FM_STANDING_DOMINATED)
            continue;
        char text[24];
        box marker = marker_box(chart, result, look);
        snprintf(text, sizeof text, "k=%.0f", result->k);
        add_label(chart, &taken, &marker, text);
    }
}

static size_t collect(double *values, const fm_group *group, const fm_error_kind *kind, bool times)
{
    size_t count = 0;
    for (size_t i = 0; i < group->count; i++) {
        const fm_case_row *one = group->cases[i];
        if (!standing_has_point(one, kind))
            continue;
        values[count++] = times ? one->metric[FM_METRIC_FRAME_MS] : error_kind_of(kind, one);
        if (times) {
            values[count++] = one->low[FM_METRIC_FRAME_MS];
            values[count++] = one->high[FM_METRIC_FRAME_MS];
        }
    }
    return count;
}

/* Axes from what will be drawn; returns how many points there are. */
static size_t fit_axes(fm_chart *chart, const fm_group *group, const fm_error_kind *kind,
                       double *values)
{
    const fm_metric_info *error = &fm_metrics[kind->metric];
    const size_t points = collect(values, group, kind, false);
    chart->x = (fm_axis){ .scale = FM_SCALE_LOG,
                          .zero_below = kind->exact_below,
                          .length_px = SPEED_ERROR_WIDTH_PX };
    snprintf(chart->x.title, sizeof chart->x.title, "error: %s%s",
             error->better == FM_BETTER_MORE ? "1 - " : "", error->name);
    axis_fit(&chart->x, values, points);
    chart->y = (fm_axis){ .title = "frame time [ms]",
                          .scale = FM_SCALE_LOG,
                          .length_px = SPEED_ERROR_HEIGHT_PX };
    axis_fit(&chart->y, values, collect(values, group, kind, true));
    return points;
}

static double most_bytes(const fm_group *group, const fm_error_kind *kind)
{
    double most = 0.0;
    for (size_t i = 0; i < group->count; i++)
        if (standing_has_point(group->cases[i], kind))
            most = fmax(most, group->cases[i]->metric[FM_METRIC_BYTES_ALLOCATED]);
    return most;
}

static void add_texts(fm_chart *chart, const fm_group *group, const look_of_points *look,
                      size_t points)
{
    snprintf(chart->title, sizeof chart->title, "Speed against error: %.120s", group->title);
    if (!look->is_cloud)
        snprintf(chart->subtitle, sizeof chart->subtitle, "%s", group->workload);
    else
        snprintf(chart->subtitle, sizeof chart->subtitle,
                 "%.120s; of %zu cases, those on the frontier or tied", group->workload, points);
    snprintf(chart->notes[0], sizeof chart->notes[0],
             "lower left is better; bars: 95 %% intervals");
    snprintf(chart->notes[1], sizeof chart->notes[1], "grey: another has no more error");
    snprintf(chart->notes[2], sizeof chart->notes[2], "and is clearly faster");
    snprintf(chart->notes[3], sizeof chart->notes[3], "marker area: memory,");
    snprintf(chart->notes[4], sizeof chart->notes[4], "the largest is %.4g MiB",
             look->bytes_most / 1048576.0);
}

static void add_points(fm_chart *chart, const fm_group *group, const look_of_points *look)
{
    for (int wanted = SORTS; wanted-- > 0;) /* the good ones last, on top */
        for (size_t i = 0; i < group->count; i++)
            if (i == 0 || !group_same_series(group->cases[i - 1], group->cases[i]))
                add_method(chart, group, i, (sort)wanted, look);
}

fm_status speed_error_chart(fm_chart *chart, const fm_group *group, const fm_error_kind *kind,
                            fm_error *err)
{
    fm_status status = FM_OK;
    *chart = (fm_chart){ 0 };
    double *values = calloc(3 * group->count + 1, sizeof *values);
    fm_place *places = calloc(group->count + 1, sizeof *places);
    box *taken = calloc(2 * group->count + 1, sizeof *taken);
    if (values == NULL || places == NULL || taken == NULL || !standings_make(places, group, kind)) {
        status = fm_fail(err, FM_NO_MEMORY, "chart of %s", group->title);
        goto out;
    }
    const size_t points = fit_axes(chart, group, kind, values);
    const look_of_points look = { kind, places, most_bytes(group, kind), points > POINTS_MOST };
    if (points == 0) {
        status = fm_fail(err, FM_UNSUPPORTED, "%s: no case has a time and an error", group->title);
        goto out;
    }
    add_frontier(chart, group, &look);
    add_points(chart, group, &look);
    add_labels(chart, group, taken, &look);
    add_texts(chart, group, &look, points);
out:
    free(values);
    free(places);
    free(taken);
    return status;
}
