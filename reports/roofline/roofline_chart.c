#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "read/group.h"
#include "roofline.h"

enum { WIDTH_PX = 620, HEIGHT_PX = 400, POINTS_MOST = 1000 };
static const fm_colour roof_grey = { 120, 120, 120 };

static bool has_point(const fm_case_row *result)
{
    return isfinite(roofline_bytes(result)) && result->metric[FM_METRIC_FRAGMENTS_PER_S] > 0.0;
}

/* How many cases are drawn: of a cloud the first. */
static size_t count_points(const fm_roofline *of)
{
    size_t count = 0;
    for (size_t i = 0; i < of->count; i++)
        count += has_point(of->cases[i]);
    return count;
}

static void fit_axes(fm_chart *chart, const fm_roofline *of, double *values)
{
    size_t count = 0;
    for (size_t i = 0; i < of->count; i++)
        if (has_point(of->cases[i]))
            values[count++] = roofline_bytes(of->cases[i]);
    chart->x = (fm_axis){ .title = "bytes moved for each fragment of the scene",
                          .scale = FM_SCALE_LOG,
                          .length_px = WIDTH_PX };
    axis_fit(&chart->x, values, count);
    count = 0;
    for (size_t i = 0; i < of->count; i++) {
        if (!has_point(of->cases[i]))
            continue;
        values[count++] = of->cases[i]->metric[FM_METRIC_FRAGMENTS_PER_S];
        values[count++] = of->cases[i]->low[FM_METRIC_FRAGMENTS_PER_S];
        values[count++] = of->cases[i]->high[FM_METRIC_FRAGMENTS_PER_S];
    }
    values[count++] = of->bytes_per_s / chart->x.high;
    values[count++] = of->fragments_per_s;
    chart->y =
        (fm_axis){ .title = "fragments a second", .scale = FM_SCALE_LOG, .length_px = HEIGHT_PX };
    axis_fit(&chart->y, values, count);
}

static void add_line(fm_chart *chart, fm_series *line, double x0, double y0, double x1, double y1)
{
    line->colour = roof_grey;
    line->width_px = 2.5;
    chart_add_point(chart, line, &(fm_point){ .x = x0, .y = y0, .low = NAN, .high = NAN });
    chart_add_point(chart, line, &(fm_point){ .x = x1, .y = y1, .low = NAN, .high = NAN });
}

/* Fragments times bytes for each are bytes: of copying a falling line, cut off where the plot ends.
 */
static void add_roofs(fm_chart *chart, const fm_roofline *of)
{
    const double left = fmax(chart->x.low, of->bytes_per_s / chart->y.high);
    const double right = fmin(chart->x.high, of->bytes_per_s / chart->y.low);
    fm_series *line = left < right ? chart_add_series(chart) : NULL;
    if (line != NULL) {
        snprintf(line->label, sizeof line->label, "copying, %.3g GB/s", 1e-9 * of->bytes_per_s);
        line->stroke = FM_STROKE_SOLID;
        add_line(chart, line, left, of->bytes_per_s / left, right, of->bytes_per_s / right);
    }
    line = isfinite(of->fragments_per_s) ? chart_add_series(chart) : NULL;
    if (line != NULL) {
        snprintf(line->label, sizeof line->label, "raster, none kept");
        line->stroke = FM_STROKE_DASHED;
        add_line(chart, line, chart->x.low, of->fragments_per_s, chart->x.high,
                 of->fragments_per_s);
    }
}

/* The points of one method, those that are ok or those that are not. */
static void add_method(fm_chart *chart, const fm_roofline *of, size_t first, bool wants_ok)
{
    const fm_case_row *one = of->cases[first];
    char title[96];
    fm_series *series = chart_add_series(chart);
    if (series == NULL)
        return;
    for (size_t i = first; i < of->count && group_same_series(of->cases[i], one); i++) {
        const fm_case_row *result = of->cases[i];
        if (has_point(result) && result->is_ok == wants_ok && i < POINTS_MOST)
            chart_add_point(chart, series,
                            &(fm_point){ .x = roofline_bytes(result),
                                         .y = result->metric[FM_METRIC_FRAGMENTS_PER_S],
                                         .low = result->low[FM_METRIC_FRAGMENTS_PER_S],
                                         .high = result->high[FM_METRIC_FRAGMENTS_PER_S] });
    }
    if (series->point_count == 0)
        return;
    group_series_title(title, one, NULL);
    snprintf(series->label, sizeof series->label, "%.76s%s", title,
             wants_ok ? "" : " (wrong image)");
    series->colour = look_family_colour(one->look.family);
    series->marker = one->look.marker;
    series->has_marker = true;
    series->hollow = !wants_ok;
    series->stroke = FM_STROKE_NONE;
}

static void add_texts(fm_chart *chart, const fm_roofline *of, size_t points)
{
    snprintf(chart->title, sizeof chart->title, "What the device allows: %.120s", of->device_name);
    if (of->count > POINTS_MOST)
        snprintf(chart->subtitle, sizeof chart->subtitle,
                 "%d of %zu cases, all workloads and feeds", POINTS_MOST, of->count);
    else
        snprintf(chart->subtitle, sizeof chart->subtitle, "%zu cases, all workloads and feeds",
                 points);
    snprintf(chart->notes[0], sizeof chart->notes[0], "upper left is better; lines: the device's");
    snprintf(chart->notes[1], sizeof chart->notes[1], "limits, as they were calibrated");
}

fm_status roofline_chart(fm_chart *chart, const fm_roofline *of, fm_error *err)
{
    const size_t points = count_points(of);
    *chart = (fm_chart){ 0 };
    if (points == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: of no case are accesses counted", of->device_name);
    double *values = calloc(3 * of->count + 2, sizeof *values);
    if (values == NULL)
        return fm_fail(err, FM_NO_MEMORY, "chart of %s", of->device_name);
    fit_axes(chart, of, values);
    add_roofs(chart, of);
    for (int ok = 0; ok < 2; ok++) /* the good ones last, on top */
        for (size_t i = 0; i < of->count; i++)
            if (i == 0 || !group_same_series(of->cases[i - 1], of->cases[i]))
                add_method(chart, of, i, ok == 1);
    add_texts(chart, of, points);
    free(values);
    return FM_OK;
}
