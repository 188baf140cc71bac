#include "figure_paper.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/text.h"
#include "figure_labels.h"
#include "read/case_metrics.h"

/* The paper's point is of the group's workload. */
static bool applies(const fm_figure_job *job, const fm_paper_point *point)
{
    for (size_t i = 0; point->at != NULL && i < point->at->count; i++) {
        const fm_yaml *item = &point->at->items[i];
        double wanted = NAN;
        const double has = case_metric(job->results, job->group->cases[0], item->key);
        if (item->text == NULL || !text_to_double(&wanted, item->text) || has != wanted)
            return false;
    }
    return true;
}

double figure_paper_value(const fm_figure_job *job, const char *method, double x)
{
    for (size_t i = 0; i < job->figure->point_count; i++) {
        const fm_paper_point *point = &job->figure->points[i];
        if (strcmp(point->method, method) == 0 && point->x == x && applies(job, point))
            return point->value;
    }
    return NAN;
}

bool figure_has_paper(const fm_figure_job *job)
{
    return job->from->with_paper && job->figure->point_count > 0 &&
           strcmp(job->figure->points_metric, job->from->y) == 0;
}

static bool has_method(const fm_figure_job *job, const char *method)
{
    for (size_t i = 0; i < job->group->count; i++)
        if (job->group->cases[i]->is_measured && strcmp(job->group->cases[i]->method, method) == 0)
            return true;
    return false;
}

static bool same_paper_series(const fm_paper_point *a, const fm_paper_point *b)
{
    return strcmp(a->method, b->method) == 0 && strcmp(a->title, b->title) == 0 && a->at == b->at;
}

/* Where another of the paper's series of this method is drawn: how many come before it, by title;
 * *is_single: there is none. */
static size_t paper_variant(bool *is_single, const fm_figure_job *job, const fm_paper_point *one)
{
    const fm_paper_point *points = job->figure->points;
    size_t variant = 0;
    *is_single = true;
    for (size_t i = 0; i < job->figure->point_count; i++) {
        const bool starts = i == 0 || !same_paper_series(&points[i - 1], &points[i]);
        if (!starts || strcmp(points[i].method, one->method) != 0 ||
            strcmp(points[i].title, one->title) == 0 || !applies(job, &points[i]))
            continue;
        variant += &points[i] < one;
        *is_single = false;
    }
    return variant;
}

/* The paper's series that starts at point `first`. Where ours is there, and the paper has no other
 * of this method, it needs no legend: colour and marker are the same. */
static void add_paper_series(fm_figure_job *job, size_t first)
{
    const fm_paper_figure *figure = job->figure;
    const fm_paper_point *one = &figure->points[first];
    fm_series *series = chart_add_series(job->chart);
    if (series == NULL)
        return;
    fm_method_info look = figure_look(job, one->method);
    bool is_single;
    const size_t variant = paper_variant(&is_single, job, one);
    figure_style_series(series, &look);
    series->colour = look_shade(series->colour, variant);
    series->hollow = true;
    series->stroke = FM_STROKE_DOTTED;
    if (!has_method(job, one->method) || !is_single)
        snprintf(series->label, sizeof series->label, "%.80s, paper", one->title);
    for (size_t i = first; i < figure->point_count; i++) {
        const fm_paper_point *from = &figure->points[i];
        fm_point point = { .x = from->x, .y = from->value, .low = NAN, .high = NAN };
        if (!same_paper_series(from, one))
            break;
        if (job->from->ratio_to != NULL)
            point.y /= figure_paper_value(job, job->from->ratio_to, from->x);
        if (!isfinite(point.y))
            continue;
        chart_add_point(job->chart, series, &point);
        figure_note_point(job, &point);
    }
}

void figure_add_paper(fm_figure_job *job)
{
    const fm_paper_figure *figure = job->figure;
    for (size_t i = 0; i < figure->point_count; i++) {
        const fm_paper_point *first = &figure->points[i];
        const bool is_base = job->from->ratio_to != NULL &&
                             strcmp(first->method, job->from->ratio_to) == 0; /* 1 by definition */
        if (!is_base && (i == 0 || !same_paper_series(&first[-1], first)) && applies(job, first))
            add_paper_series(job, i);
    }
}
