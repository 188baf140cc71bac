#include "figure_charts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double plot_width_px = 560, plot_height_px = 380;

/* What the functions below share while one chart is made. */
typedef struct job {
    fm_chart *chart;
    const fm_paper_figure *figure;
    const fm_figure_chart *from;
    const fm_result_files *results;
    const fm_group *group;
    double *x, *y; /* values that the axes must hold; room in both for all points */
    size_t x_count, y_count;
} job;

fm_figure_cases figure_cases(const fm_result_files *results, const fm_paper_figure *figure)
{
    return (fm_figure_cases){ figure, result_files_figure(results, figure->id) };
}

bool figure_takes_case(const fm_case_row *result, const void *cases)
{
    const fm_figure_cases *of = cases;
    if (of->bit != 0)
        return (result->figures & of->bit) != 0;
    return name_list_has(&of->figure->methods, result->method) &&
           name_list_has(&of->figure->scenes, result->scene) &&
           name_list_has(&of->figure->feeds, result->feed);
}

static bool is_level(const job *at, const fm_case_row *result)
{
    return strcmp(at->from->x, "k") == 0 && !group_uses_k(at->group, result);
}

static double x_of(const job *at, const fm_case_row *result)
{
    return result_files_metric(at->results, result, at->from->x);
}

/* y with its interval; only frame_ms has one. */
static fm_point y_of(const job *at, const fm_case_row *result)
{
    fm_point point = { .y = result_files_metric(at->results, result, at->from->y),
                       .low = NAN,
                       .high = NAN };
    if (strcmp(at->from->y, "frame_ms") == 0) {
        point.low = result->frame_ms_low;
        point.high = result->frame_ms_high;
    }
    return point;
}

/* The case that ratios at x are taken to; NULL: it was not measured there. */
static const fm_case_row *base_at(const job *at, double x)
{
    for (size_t i = 0; i < at->group->count; i++) {
        const fm_case_row *other = at->group->cases[i];
        if (strcmp(other->method, at->from->ratio_to) == 0 && other->is_measured &&
            (is_level(at, other) || x_of(at, other) == x))
            return other;
    }
    return NULL;
}

/* The value to draw at x, as a ratio where the chart wants one; false: none. The interval of a
 * ratio is the widest that both intervals allow. */
static bool value_at(fm_point *point, const job *at, const fm_case_row *result, double x)
{
    *point = y_of(at, result);
    point->x = x;
    if (at->from->ratio_to != NULL) {
        const fm_case_row *base = base_at(at, x);
        if (base == NULL)
            return false;
        fm_point by = y_of(at, base);
        point->y /= by.y;
        point->low = base == result ? NAN : point->low / by.high;
        point->high = base == result ? NAN : point->high / by.low;
    }
    return isfinite(point->y) && isfinite(x) && !(at->from->is_log && point->y <= 0.0);
}

static void note_point(job *at, const fm_point *point)
{
    at->x[at->x_count++] = point->x;
    at->y[at->y_count++] = point->y;
    at->y[at->y_count++] = point->low;
    at->y[at->y_count++] = point->high;
}

static void style_series(fm_series *series, const fm_method_info *look)
{
    series->colour = look_family_colour(look->family);
    series->marker = look->marker;
    series->has_marker = true;
    series->stroke = look->is_dashed ? FM_STROKE_DASHED : FM_STROKE_SOLID;
}

static void label_ours(fm_series *series, const fm_case_row *one)
{
    char title[96];
    if (series->point_count == 0)
        return;
    group_series_title(title, one);
    snprintf(series->label, sizeof series->label, "%.76s%s", title,
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

/* Our points of the series that starts at case `first`, at x's own, or level at all others' x. */
static void add_ours(job *at, size_t first, const double *xs, size_t x_count)
{
    const fm_case_row *one = at->group->cases[first];
    fm_series *series = chart_add_series(at->chart, at->group->count + x_count);
    if (series == NULL)
        return;
    style_series(series, &one->look);
    for (size_t i = first; i < at->group->count && group_same_series(at->group->cases[i], one);
         i++) {
        const fm_case_row *result = at->group->cases[i];
        bool level = is_level(at, result);
        for (size_t j = 0; result->is_measured && j < (level ? x_count : 1); j++) {
            fm_point *point = &series->points[series->point_count];
            if (!value_at(point, at, result, level ? xs[j] : x_of(at, result)))
                continue;
            note_point(at, point);
            series->point_count++;
        }
    }
    label_ours(series, one);
    if (is_level(at, one) && at->from->ratio_to == NULL)
        level_line(series);
}

static double paper_value(const fm_paper_figure *figure, const char *method, double x)
{
    for (size_t i = 0; i < figure->point_count; i++)
        if (strcmp(figure->points[i].method, method) == 0 && figure->points[i].x == x)
            return figure->points[i].value;
    return NAN;
}

static fm_method_info paper_look(const job *at, const char *method)
{
    for (size_t i = 0; i < at->group->count; i++)
        if (strcmp(at->group->cases[i]->method, method) == 0)
            return at->group->cases[i]->look;
    const fm_method_info *info = provenance_method(at->results->manifest, method);
    return info != NULL ? *info : (fm_method_info){ .id = method };
}

static void add_paper(job *at)
{
    const fm_paper_figure *figure = at->figure;
    for (size_t i = 0; i < figure->point_count; i++) {
        const fm_paper_point *first = &figure->points[i];
        bool is_base = strcmp(first->method, at->from->ratio_to) == 0; /* 1 by definition */
        if (is_base || (i > 0 && strcmp(first[-1].method, first->method) == 0))
            continue;
        fm_series *series = chart_add_series(at->chart, figure->point_count);
        if (series == NULL)
            return;
        fm_method_info look = paper_look(at, first->method);
        style_series(series, &look);
        series->hollow = true;
        series->stroke = FM_STROKE_DOTTED;
        snprintf(series->label, sizeof series->label, "%.80s, paper", first->title);
        for (size_t j = i; j < figure->point_count; j++) {
            if (strcmp(figure->points[j].method, first->method) != 0)
                break;
            double x = figure->points[j].x;
            fm_point point = { .x = x, .low = NAN, .high = NAN };
            point.y = figure->points[j].value / paper_value(figure, at->from->ratio_to, x);
            if (!isfinite(point.y))
                continue;
            series->points[series->point_count++] = point;
            note_point(at, &point);
        }
    }
}

/* The distinct x of all measured cases that use x, rising; at least one when anything is measured.
 */
static size_t distinct_x(double *xs, const job *at)
{
    size_t count = 0;
    for (size_t pass = 0; pass < 2 && count == 0; pass++)
        for (size_t i = 0; i < at->group->count; i++) {
            const fm_case_row *result = at->group->cases[i];
            double x = x_of(at, result);
            if (!result->is_measured || !isfinite(x) || (pass == 0 && is_level(at, result)))
                continue;
            size_t place = count;
            while (place > 0 && xs[place - 1] >= x)
                place--;
            if (place < count && xs[place] == x)
                continue;
            memmove(xs + place + 1, xs + place, (count - place) * sizeof *xs);
            xs[place] = x;
            count++;
        }
    return count;
}

static const char *unit_of(const char *metric)
{
    size_t length = strlen(metric);
    if (length > 3 && strcmp(metric + length - 3, "_ms") == 0)
        return "ms";
    return strncmp(metric, "bytes_", 6) == 0 ? "bytes" : "";
}

static void title_axes(job *at)
{
    fm_axis *x = &at->chart->x, *y = &at->chart->y;
    const char *metric = strcmp(at->from->y, "frame_ms") == 0 ? "frame time" : at->from->y;
    const char *unit = unit_of(at->from->y);
    if (strcmp(at->from->x, "k") == 0)
        snprintf(x->title, sizeof x->title, "k (fragments kept per pixel)");
    else
        snprintf(x->title, sizeof x->title, "%.100s", at->from->x);
    if (at->from->ratio_to != NULL)
        snprintf(y->title, sizeof y->title, "%.50s / that of %.50s", metric,
                 paper_look(at, at->from->ratio_to).title != NULL
                     ? paper_look(at, at->from->ratio_to).title
                     : at->from->ratio_to);
    else
        snprintf(y->title, sizeof y->title, "%.60s%s%s%s", metric, unit[0] == '\0' ? "" : " [",
                 unit, unit[0] == '\0' ? "" : "]");
}

static fm_status make_lines(job *at, double *xs, fm_error *err)
{
    fm_chart *chart = at->chart;
    size_t x_count = distinct_x(xs, at);
    if (at->from->with_paper && at->from->ratio_to != NULL)
        add_paper(at);
    size_t paper_values = at->y_count;
    for (size_t i = 0; i < at->group->count; i++)
        if (i == 0 || !group_same_series(at->group->cases[i - 1], at->group->cases[i]))
            add_ours(at, i, xs, x_count);
    if (at->y_count == paper_values)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case has %s%s%s", at->group->title, at->from->y,
                       at->from->ratio_to == NULL ? "" : " and one of ",
                       at->from->ratio_to == NULL ? "" : at->from->ratio_to);
    chart->x.scale = FM_SCALE_LOG;
    for (size_t i = 0; i < at->x_count; i++)
        if (at->x[i] <= 0.0)
            chart->x.scale = FM_SCALE_LINEAR;
    chart->y.scale = at->from->is_log ? FM_SCALE_LOG : FM_SCALE_LINEAR;
    axis_fit(&chart->x, at->x, at->x_count);
    axis_tick_values(&chart->x, at->x, at->x_count);
    axis_fit(&chart->y, at->y, at->y_count);
    title_axes(at);
    snprintf(chart->notes[0], sizeof chart->notes[0], "bars: 95 %% intervals");
    if (at->from->with_paper && at->figure->point_count > 0)
        snprintf(chart->notes[1], sizeof chart->notes[1], "hollow: paper, digitised");
    return FM_OK;
}

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

static double add_stack(job *at, bar_place *place, const fm_case_row *result)
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

static void add_cluster_title(job *at, double from, double to, const char *text)
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
static void add_cluster(job *at, bar_place *place, double x, bool level)
{
    char text[64];
    double from = place->slot;
    for (size_t i = 0; i < at->group->count; i++) {
        const fm_case_row *result = at->group->cases[i];
        if (!result->is_measured || is_level(at, result) != level ||
            (!level && x_of(at, result) != x))
            continue;
        at->y[at->y_count++] = add_stack(at, place, result);
        add_upright(at->chart, place, result);
        place->slot += 1.0;
    }
    if (place->slot == from)
        return;
    if (level)
        snprintf(text, sizeof text, "any %.32s", at->from->x);
    else
        snprintf(text, sizeof text, "%.32s = %.6g", at->from->x, x);
    add_cluster_title(at, from, place->slot, text);
    place->slot += 1.0;
}

static void add_part_keys(job *at)
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

static fm_status make_bars(job *at, double *xs, fm_error *err)
{
    fm_chart *chart = at->chart;
    bar_place place = { .slot = 0.5 };
    size_t x_count = distinct_x(xs, at);
    for (size_t i = 0; i < x_count; i++)
        add_cluster(at, &place, xs[i], false);
    add_cluster(at, &place, NAN, true);
    if (at->y_count == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case was measured", at->group->title);
    axis_fit(&chart->y, at->y, at->y_count);
    snprintf(chart->y.title, sizeof chart->y.title, "time [ms]");
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

fm_status figure_chart_make(fm_chart *chart, const fm_paper_figure *figure,
                            const fm_figure_chart *from, const fm_result_files *results,
                            const fm_group *group, fm_error *err)
{
    fm_status status = FM_OK;
    size_t room = (group->count + 1) * (group->count + 1) + figure->point_count;
    *chart = (fm_chart){ .x.length_px = plot_width_px, .y.length_px = plot_height_px };
    job at = { chart, figure, from, results, group, NULL, NULL, 0, 0 };
    double *xs = calloc(group->count + 1, sizeof *xs);
    at.x = calloc(room, sizeof *at.x);
    at.y = calloc(room, 3 * sizeof *at.y);
    if (xs == NULL || at.x == NULL || at.y == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "figure %s", figure->id);
        goto out;
    }
    snprintf(chart->title, sizeof chart->title, "%.40s: %.110s", figure->id, from->title);
    snprintf(chart->subtitle, sizeof chart->subtitle, "%.90s; %.100s", group->title,
             group->workload);
    status = from->kind == FM_FIGURE_LINES ? make_lines(&at, xs, err) : make_bars(&at, xs, err);
out:
    free(xs);
    free(at.x);
    free(at.y);
    return status;
}
