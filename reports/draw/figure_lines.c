/* Kind `lines`: a curve for each method, ours and the paper's. */
#include "figure_job.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "read/interval.h"
#include "read/options.h"

fm_interval figure_y(const fm_figure_job *at, const fm_case_row *result)
{
    size_t samples;
    return result_files_interval(&samples, at->results, result, at->from->ys.names,
                                 at->from->ys.count);
}

const fm_case_row *figure_base_at(const fm_figure_job *at, double x)
{
    for (size_t i = 0; i < at->group->count; i++) {
        const fm_case_row *other = at->group->cases[i];
        if (strcmp(other->method, at->from->ratio_to) == 0 && other->is_measured &&
            (figure_is_level(at, other) || figure_x(at, other) == x))
            return other;
    }
    return NULL;
}

/* The value to draw at x, as a ratio where the chart wants one; false: none. */
static bool value_at(fm_point *point, const fm_figure_job *at, const fm_case_row *result, double x)
{
    fm_interval y = figure_y(at, result);
    if (at->from->ratio_to != NULL) {
        const fm_case_row *base = figure_base_at(at, x);
        if (base == NULL)
            return false;
        y = interval_ratio(y, figure_y(at, base));
        if (base == result)
            y.low = y.high = y.median;
    }
    const bool has_interval = y.high > y.low;
    *point = (fm_point){ .x = x,
                         .y = y.median,
                         .low = has_interval ? y.low : NAN,
                         .high = has_interval ? y.high : NAN };
    return isfinite(point->y) && isfinite(x) && !(at->from->is_log && point->y <= 0.0);
}

static void note_point(fm_figure_job *at, const fm_point *point)
{
    figure_note_x(at, point->x);
    figure_note_y(at, point->y);
    figure_note_y(at, point->low);
    figure_note_y(at, point->high);
}

static void style_series(fm_series *series, const fm_method_info *look)
{
    series->colour = look_family_colour(look->family);
    series->marker = look->marker;
    series->has_marker = true;
    series->stroke = look->is_dashed ? FM_STROKE_DASHED : FM_STROKE_SOLID;
}

/* A method without a k joins the workloads of others that differ in it. */
static bool has_other_k(const fm_figure_job *at, const fm_case_row *one)
{
    const fm_name_list free_columns = figure_free_columns(at->from);
    bool differs = false;
    for (size_t i = 0; i < at->group->count && !name_list_names(&free_columns, "k"); i++) {
        const fm_case_row *other = at->group->cases[i];
        differs |= strcmp(other->method, one->method) == 0 && other->k != one->k;
    }
    return differs && !isnan(one->k);
}

static void label_ours(fm_series *series, const fm_figure_job *at, const fm_case_row *one)
{
    const fm_name_list free_columns = figure_free_columns(at->from);
    char title[96], k[24] = "";
    if (series->point_count == 0)
        return;
    group_series_title(title, one, &free_columns);
    if (has_other_k(at, one))
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

bool figure_is_same_series(const fm_figure_job *at, size_t a, size_t b)
{
    const fm_name_list free_columns = figure_free_columns(at->from);
    const fm_case_row *one = at->group->cases[a], *other = at->group->cases[b];
    const bool same_k = one->k == other->k || (isnan(one->k) && isnan(other->k));
    return strcmp(one->method, other->method) == 0 &&
           (same_k || name_list_names(&free_columns, "k")) &&
           options_are_same(one->options, other->options, FM_OPTIONS_OWN, &free_columns);
}

bool figure_starts_series(const fm_figure_job *at, size_t i)
{
    for (size_t before = 0; before < i; before++)
        if (figure_is_same_series(at, before, i))
            return false;
    return true;
}

/* Series of one method with other options: darker, other markers, and every second one dashed. */
static void tell_variants_apart(fm_series *series, const fm_figure_job *at, size_t first)
{
    const fm_group *group = at->group;
    size_t variant = 0;
    for (size_t i = 0; i < first; i++)
        variant += strcmp(group->cases[i]->method, group->cases[first]->method) == 0 &&
                   figure_starts_series(at, i);
    series->marker = (fm_marker)(((size_t)series->marker + variant) % FM_MARKER_COUNT);
    series->colour = look_shade(series->colour, variant);
    if (variant % 2 == 1)
        series->stroke = series->stroke == FM_STROKE_SOLID ? FM_STROKE_DASHED : FM_STROKE_SOLID;
}

/* The points of the series that starts at case `first`, at x's own, or level at all others' x. What
 * the axes must hold is noted in `axes`. */
static fm_series *add_series(const fm_figure_job *at, fm_figure_job *axes, size_t first,
                             const double *xs, size_t x_count)
{
    const fm_case_row *one = at->group->cases[first];
    fm_series *series = chart_add_series(at->chart);
    if (series == NULL)
        return NULL;
    style_series(series, &one->look);
    tell_variants_apart(series, at, first);
    for (size_t i = first; i < at->group->count; i++) {
        const fm_case_row *result = at->group->cases[i];
        if (!figure_is_same_series(at, first, i))
            continue;
        bool level = figure_is_level(at, result);
        for (size_t j = 0; result->is_measured && j < (level ? x_count : 1); j++) {
            fm_point point;
            if (!value_at(&point, at, result, level ? xs[j] : figure_x(at, result)))
                continue;
            chart_add_point(at->chart, series, &point);
            note_point(axes, &point);
        }
    }
    if (series->point_count > 1)
        qsort(series->points, series->point_count, sizeof *series->points, compare_x);
    if (figure_is_level(at, one) && at->from->ratio_to == NULL)
        level_line(series);
    return series;
}

static void add_ours(fm_figure_job *at, const double *xs, size_t x_count)
{
    for (size_t i = 0; i < at->group->count; i++) {
        fm_series *series = figure_starts_series(at, i) ? add_series(at, at, i, xs, x_count) : NULL;
        if (series != NULL)
            label_ours(series, at, at->group->cases[i]);
    }
}

/* Another machine's curves: thin, without markers, colours as ours and therefore without legend. */
static void add_reference(fm_figure_job *at, const fm_figure_job *reference, const double *xs,
                          size_t x_count)
{
    for (size_t i = 0; reference->group != NULL && i < reference->group->count; i++) {
        fm_series *series =
            figure_starts_series(reference, i) ? add_series(reference, at, i, xs, x_count) : NULL;
        if (series == NULL)
            continue;
        series->has_marker = false;
        series->width_px = 0.8;
        for (size_t j = 0; j < series->point_count; j++)
            series->points[j].low = series->points[j].high = NAN;
    }
}

/* The paper's point is of the group's workload. */
static bool applies(const fm_figure_job *at, const fm_paper_point *point)
{
    for (size_t i = 0; point->at != NULL && i < point->at->count; i++) {
        const fm_yaml *item = &point->at->items[i];
        double wanted = NAN;
        const double has = result_files_metric(at->results, at->group->cases[0], item->key);
        if (item->text == NULL || !text_to_double(&wanted, item->text) || has != wanted)
            return false;
    }
    return true;
}

double figure_paper_value(const fm_figure_job *at, const char *method, double x)
{
    for (size_t i = 0; i < at->figure->point_count; i++) {
        const fm_paper_point *point = &at->figure->points[i];
        if (strcmp(point->method, method) == 0 && point->x == x && applies(at, point))
            return point->value;
    }
    return NAN;
}

static fm_method_info paper_look(const fm_figure_job *at, const char *method)
{
    for (size_t i = 0; i < at->group->count; i++)
        if (strcmp(at->group->cases[i]->method, method) == 0)
            return at->group->cases[i]->look;
    const fm_method_info *info = provenance_method(at->results->manifest, method);
    return info != NULL ? *info : (fm_method_info){ .id = method };
}

static bool has_method(const fm_figure_job *at, const char *method)
{
    for (size_t i = 0; i < at->group->count; i++)
        if (at->group->cases[i]->is_measured && strcmp(at->group->cases[i]->method, method) == 0)
            return true;
    return false;
}

static bool same_paper_series(const fm_paper_point *a, const fm_paper_point *b)
{
    return strcmp(a->method, b->method) == 0 && strcmp(a->title, b->title) == 0 && a->at == b->at;
}

/* Where another of the paper's series of this method is drawn: how many come before it, by title;
 * *is_single: there is none. */
static size_t paper_variant(bool *is_single, const fm_figure_job *at, const fm_paper_point *one)
{
    const fm_paper_point *points = at->figure->points;
    size_t variant = 0;
    *is_single = true;
    for (size_t i = 0; i < at->figure->point_count; i++) {
        const bool starts = i == 0 || !same_paper_series(&points[i - 1], &points[i]);
        if (!starts || strcmp(points[i].method, one->method) != 0 ||
            strcmp(points[i].title, one->title) == 0 || !applies(at, &points[i]))
            continue;
        variant += &points[i] < one;
        *is_single = false;
    }
    return variant;
}

/* The paper's series that starts at point `first`. Where ours is there, and the paper has no other
 * of this method, it needs no legend: colour and marker are the same. */
static void add_paper_series(fm_figure_job *at, size_t first)
{
    const fm_paper_figure *figure = at->figure;
    const fm_paper_point *one = &figure->points[first];
    fm_series *series = chart_add_series(at->chart);
    if (series == NULL)
        return;
    fm_method_info look = paper_look(at, one->method);
    bool is_single;
    const size_t variant = paper_variant(&is_single, at, one);
    style_series(series, &look);
    series->colour = look_shade(series->colour, variant);
    series->hollow = true;
    series->stroke = FM_STROKE_DOTTED;
    if (!has_method(at, one->method) || !is_single)
        snprintf(series->label, sizeof series->label, "%.80s, paper", one->title);
    for (size_t i = first; i < figure->point_count; i++) {
        const fm_paper_point *from = &figure->points[i];
        fm_point point = { .x = from->x, .y = from->value, .low = NAN, .high = NAN };
        if (!same_paper_series(from, one))
            break;
        if (at->from->ratio_to != NULL)
            point.y /= figure_paper_value(at, at->from->ratio_to, from->x);
        if (!isfinite(point.y))
            continue;
        chart_add_point(at->chart, series, &point);
        note_point(at, &point);
    }
}

bool figure_has_paper(const fm_figure_job *at)
{
    return at->from->with_paper && at->figure->point_count > 0 &&
           strcmp(at->figure->points_metric, at->from->y) == 0;
}

static void add_paper(fm_figure_job *at)
{
    const fm_paper_figure *figure = at->figure;
    for (size_t i = 0; i < figure->point_count; i++) {
        const fm_paper_point *first = &figure->points[i];
        const bool is_base = at->from->ratio_to != NULL &&
                             strcmp(first->method, at->from->ratio_to) == 0; /* 1 by definition */
        if (!is_base && (i == 0 || !same_paper_series(&first[-1], first)) && applies(at, first))
            add_paper_series(at, i);
    }
}

/* Titles of what is drawn, where the column's name is not enough. */
static const struct {
    const char *name, *title, *unit;
} quantities[] = {
    { "frame_ms", "frame time", "ms" },
    { "fps", "frames per second", "" },
    { "mib", "memory", "MiB" },
    { "fps_per_mib", "frames per second and MiB", "" },
    { "reference_ms", "referencing step", "ms" },
    { "k", "k (fragments kept per pixel)", "" },
    { "n", "n (layers)", "" },
    { "pixel_density", "pixel density", "" },
    { "tessellation", "tessellation (cells a side)", "" },
    { "width_px", "width of the viewport", "px" },
};

static void quantity_title(char title[128], const char *name, const char *unit)
{
    for (size_t i = 0; i < sizeof quantities / sizeof quantities[0]; i++)
        if (strcmp(quantities[i].name, name) == 0) {
            name = quantities[i].title;
            unit = quantities[i].unit;
            break;
        }
    snprintf(title, 128, "%.80s%s%s%s", name, unit[0] == '\0' ? "" : " [", unit,
             unit[0] == '\0' ? "" : "]");
}

static const char *unit_of(const char *metric)
{
    size_t length = strlen(metric);
    if (length > 3 && strcmp(metric + length - 3, "_ms") == 0)
        return "ms";
    return strncmp(metric, "bytes_", 6) == 0 ? "bytes" : "";
}

void figure_title_quantity(char title[128], const fm_name_list *metrics)
{
    quantity_title(title, metrics->names[0], unit_of(metrics->names[0]));
}

void figure_title_ratio(char title[128], const fm_figure_job *at)
{
    char own[128];
    const fm_method_info look = paper_look(at, at->from->ratio_to);
    quantity_title(own, at->from->y, "");
    snprintf(title, 128, "%.*s / that of %.50s", (int)strcspn(own, "["), own,
             look.title != NULL ? look.title : at->from->ratio_to);
}

static void title_axes(fm_figure_job *at)
{
    quantity_title(at->chart->x.title, at->from->x, "");
    if (at->from->ratio_to == NULL)
        figure_title_quantity(at->chart->y.title, &at->from->ys);
    else
        figure_title_ratio(at->chart->y.title, at);
}

static void fit_numbers(fm_figure_job *at)
{
    fm_axis *x = &at->chart->x;
    x->scale = FM_SCALE_LOG;
    for (size_t i = 0; i < at->x.count; i++)
        if (at->x.items[i] <= 0.0)
            x->scale = FM_SCALE_LINEAR;
    axis_fit(x, at->x.items, at->x.count);
    axis_tick_values(x, at->x.items, at->x.count);
}

/* Ticks without numbers, and the scenes' names below them, in place of a title. */
static void name_scenes(fm_figure_job *at)
{
    fm_axis *x = &at->chart->x;
    size_t widest = 0;
    x->scale = FM_SCALE_LINEAR;
    x->low = 0.5;
    x->high = (double)at->figure->scenes.count + 0.5;
    x->title[0] = '\0';
    for (size_t place = 1; place <= at->figure->scenes.count; place++) {
        const size_t width = figure_add_upright(at->chart, axis_position(x, (double)place),
                                                figure_scene_name(at, place));
        widest = width > widest ? width : widest;
        if (x->tick_count < FM_AXIS_TICKS)
            x->ticks[x->tick_count++] = (fm_tick){ .value = (double)place };
    }
    at->chart->bottom_px = (int)widest + 24;
}

fm_status figure_make_lines(fm_figure_job *at, const fm_figure_job *reference, double *xs,
                            fm_error *err)
{
    fm_chart *chart = at->chart;
    const size_t x_count = figure_distinct_x(xs, at);
    add_ours(at, xs, x_count);
    const size_t own_values = at->y.count;
    if (figure_has_paper(at))
        add_paper(at);
    const size_t paper_values = at->y.count;
    add_reference(at, reference, xs, x_count);
    if (own_values == 0)
        return fm_fail(err, FM_UNSUPPORTED, "%s: no case has %s%s%s", at->group->title, at->from->y,
                       at->from->ratio_to == NULL ? "" : " and one of ",
                       at->from->ratio_to == NULL ? "" : at->from->ratio_to);
    chart->y.scale = at->from->is_log ? FM_SCALE_LOG : FM_SCALE_LINEAR;
    axis_fit(&chart->y, at->y.items, at->y.count);
    title_axes(at);
    if (figure_is_by_scene(at))
        name_scenes(at);
    else
        fit_numbers(at);
    size_t note = 0;
    snprintf(chart->notes[note++], sizeof chart->notes[0], "bars: 95 %% intervals");
    if (paper_values > own_values)
        snprintf(chart->notes[note++], sizeof chart->notes[0], "hollow: the paper");
    if (at->y.count > paper_values)
        snprintf(chart->notes[note++], sizeof chart->notes[0], "thin: %.50s",
                 reference->group->cases[0]->device_name);
    return FM_OK;
}
