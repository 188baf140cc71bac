#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "speed_error.h"

static fm_status place_points(fm_place *places, const fm_overall *overall, fm_error *err)
{
    fm_contender *contenders = calloc(overall->point_count + 1, sizeof *contenders);
    if (contenders == NULL)
        return fm_fail(err, FM_NO_MEMORY, "chart of %zu methods", overall->point_count);
    for (size_t i = 0; i < overall->point_count; i++)
        contenders[i] = (fm_contender){ 0, overall->points[i].error, overall->points[i].ratio, i };
    contenders_place(places, contenders, overall->point_count);
    free(contenders);
    return FM_OK;
}

static double end_of(double value)
{
    return isfinite(value) && value > 0 ? value : NAN;
}

static void add_method(fm_chart *chart, const fm_overall *overall, size_t first,
                       const fm_place *places, bool wants_dominated)
{
    const fm_case_row *one = overall->points[first].row;
    fm_series *series = chart_add_series(chart);
    char title[96];
    if (series == NULL)
        return;
    for (size_t i = first; i < overall->point_count; i++) {
        const fm_overall_point *point = &overall->points[i];
        if (group_same_series(point->row, one) &&
            (places[i].standing == FM_STANDING_DOMINATED) == wants_dominated)
            chart_add_point(chart, series,
                            &(fm_point){ .x = point->error,
                                         .y = point->ratio.value,
                                         .low = end_of(point->ratio.low),
                                         .high = end_of(point->ratio.high) });
    }
    if (series->point_count == 0)
        return;
    group_series_title(title, one, NULL);
    if (!wants_dominated)
        snprintf(series->label, sizeof series->label, "%.90s", title);
    series->colour =
        wants_dominated ? look_dominated_colour() : look_family_colour(one->look.family);
    series->marker = one->look.marker;
    series->has_marker = true;
    series->stroke = FM_STROKE_NONE;
}

static void add_label(fm_chart *chart, const fm_overall_point *point)
{
    fm_label *label = isnan(point->row->k) ? NULL : chart_add_label(chart);
    if (label == NULL)
        return;
    *label = (fm_label){ .x_px = axis_position(&chart->x, point->error) + 8,
                         .y_px = axis_position(&chart->y, point->ratio.value) + 4,
                         .size_px = SPEED_ERROR_LABEL_PX };
    snprintf(label->text, sizeof label->text, "k=%.0f", point->row->k);
}

static void fit_axes(fm_chart *chart, const fm_overall *overall, const fm_error_kind *kind,
                     double *values)
{
    for (size_t i = 0; i < overall->point_count; i++)
        values[i] = overall->points[i].error;
    chart->x = (fm_axis){ .scale = FM_SCALE_LOG,
                          .zero_below = kind->exact_below,
                          .length_px = SPEED_ERROR_WIDTH_PX };
    snprintf(chart->x.title, sizeof chart->x.title, "error: the worst of all, %s%s",
             fm_metrics[kind->metric].better == FM_BETTER_MORE ? "1 - " : "",
             fm_metrics[kind->metric].name);
    axis_fit(&chart->x, values, overall->point_count);
    for (size_t i = 0; i < overall->point_count; i++) {
        values[3 * i] = overall->points[i].ratio.value;
        values[3 * i + 1] = end_of(overall->points[i].ratio.low);
        values[3 * i + 2] = end_of(overall->points[i].ratio.high);
    }
    chart->y = (fm_axis){ .title = "time over the cheapest exact one's, geometric mean",
                          .scale = FM_SCALE_LOG,
                          .length_px = SPEED_ERROR_HEIGHT_PX };
    axis_fit(&chart->y, values, 3 * overall->point_count);
}

static void add_texts(fm_chart *chart, const fm_overall *overall)
{
    snprintf(chart->title, sizeof chart->title, "Speed against error, all told: %.40s, %.40s",
             overall->device, overall->feed);
    snprintf(chart->subtitle, sizeof chart->subtitle,
             "%zu workloads of %zu scenes; methods that are ok in all of them",
             overall->workload_count, overall->scene_count);
    snprintf(chart->notes[0], sizeof chart->notes[0],
             "lower left is better; bars: where the ratio is,");
    snprintf(chart->notes[1], sizeof chart->notes[1], "if the intervals hold the times");
    snprintf(chart->notes[2], sizeof chart->notes[2], "grey: another has no more error");
    snprintf(chart->notes[3], sizeof chart->notes[3], "and is clearly faster");
}

fm_status speed_error_overall_chart(fm_chart *chart, const fm_overall *overall,
                                    const fm_error_kind *kind, fm_error *err)
{
    *chart = (fm_chart){ 0 };
    if (overall->point_count == 0)
        return fm_fail(err, FM_UNSUPPORTED, "no method is ok in all %zu workloads",
                       overall->workload_count);
    double *values = calloc(3 * overall->point_count, sizeof *values);
    fm_place *places = calloc(overall->point_count, sizeof *places);
    fm_status status = values != NULL && places != NULL
                           ? place_points(places, overall, err)
                           : fm_fail(err, FM_NO_MEMORY, "chart of all workloads");
    if (status == FM_OK) {
        fit_axes(chart, overall, kind, values);
        for (int dominated = 1; dominated >= 0; dominated--)
            for (size_t i = 0; i < overall->point_count; i++)
                if (i == 0 ||
                    !group_same_series(overall->points[i - 1].row, overall->points[i].row))
                    add_method(chart, overall, i, places, dominated == 1);
        for (size_t i = 0; i < overall->point_count; i++)
            if (places[i].standing != FM_STANDING_DOMINATED)
                add_label(chart, &overall->points[i]);
        add_texts(chart, overall);
    }
    free(values);
    free(places);
    return status;
}
