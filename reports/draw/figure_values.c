#include "figure_values.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "read/case_metrics.h"
#include "read/options.h"

static void note(fm_figure_job *job, fm_numbers *numbers, double value)
{
    if (numbers->count == numbers->capacity) {
        const size_t capacity = numbers->capacity > 0 ? 2 * numbers->capacity : 64;
        double *items = reallocarray(numbers->items, capacity, sizeof *items);
        if (items == NULL) {
            job->chart->failed = true;
            return;
        }
        numbers->items = items;
        numbers->capacity = capacity;
    }
    numbers->items[numbers->count++] = value;
}

void figure_note_y(fm_figure_job *job, double value)
{
    note(job, &job->y, value);
}

void figure_note_point(fm_figure_job *job, const fm_point *point)
{
    note(job, &job->x, point->x);
    figure_note_y(job, point->y);
    figure_note_y(job, point->low);
    figure_note_y(job, point->high);
}

bool figure_is_by_scene(const fm_figure_job *job)
{
    return strcmp(job->from->x, "scene") == 0;
}

/* Where n = r k, the layers of a case without a k tell which k the others have; else NAN. */
static double k_of_workload(const fm_case_row *result)
{
    return result->metric[FM_METRIC_N] / result->r;
}

bool figure_is_level(const fm_figure_job *job, const fm_case_row *result)
{
    return strcmp(job->from->x, "k") == 0 && !group_uses_k(job->group, result) &&
           isnan(k_of_workload(result));
}

/* Scenes are numbered as the figure lists them. */
double figure_x(const fm_figure_job *job, const fm_case_row *result)
{
    for (size_t i = 0; figure_is_by_scene(job) && i < job->figure->scenes.count; i++)
        if (strcmp(job->figure->scenes.items[i], result->scene) == 0)
            return (double)(i + 1);
    if (strcmp(job->from->x, "k") == 0 && isnan(result->k))
        return k_of_workload(result);
    return case_place(job->results, result, job->from->x);
}

/* Keeps the places distinct, and rising. */
static void add_place(fm_figure_job *job, double x)
{
    fm_numbers *places = &job->places;
    size_t place = places->count;
    while (place > 0 && places->items[place - 1] >= x)
        place--;
    if (place < places->count && places->items[place] == x)
        return;
    note(job, places, x);
    if (job->chart->failed)
        return;
    memmove(places->items + place + 1, places->items + place,
            (places->count - 1 - place) * sizeof *places->items);
    places->items[place] = x;
}

void figure_find_places(fm_figure_job *job)
{
    for (size_t pass = 0; pass < 2 && job->places.count == 0; pass++)
        for (size_t i = 0; i < job->group->count; i++) {
            const fm_case_row *result = job->group->cases[i];
            const double x = figure_x(job, result);
            if (result->is_measured && isfinite(x) && !(pass == 0 && figure_is_level(job, result)))
                add_place(job, x);
        }
}

void figure_job_free(fm_figure_job *job)
{
    free(job->places.items);
    free(job->x.items);
    free(job->y.items);
}

fm_interval figure_y(const fm_figure_job *job, const fm_case_row *result)
{
    return case_interval(job->results, result, text_list_items(&job->from->ys),
                         job->from->ys.count);
}

const fm_case_row *figure_base_at(const fm_figure_job *job, double x)
{
    for (size_t i = 0; i < job->group->count; i++) {
        const fm_case_row *other = job->group->cases[i];
        if (strcmp(other->method, job->from->ratio_to) == 0 && other->is_measured &&
            (figure_is_level(job, other) || figure_x(job, other) == x))
            return other;
    }
    return NULL;
}

bool figure_is_same_series(const fm_figure_job *job, size_t a, size_t b)
{
    const fm_text_list *free_columns = &job->from->free_columns;
    const fm_case_row *one = job->group->cases[a], *other = job->group->cases[b];
    const bool same_k = one->k == other->k || (isnan(one->k) && isnan(other->k));
    return strcmp(one->method, other->method) == 0 &&
           (same_k || text_list_has(free_columns, "k")) &&
           options_are_same(one->options, other->options, FM_OPTIONS_OWN, free_columns);
}

bool figure_starts_series(const fm_figure_job *job, size_t i)
{
    for (size_t before = 0; before < i; before++)
        if (figure_is_same_series(job, before, i))
            return false;
    return true;
}

fm_method_info figure_look(const fm_figure_job *job, const char *method)
{
    for (size_t i = 0; i < job->group->count; i++)
        if (strcmp(job->group->cases[i]->method, method) == 0)
            return job->group->cases[i]->look;
    const fm_method_info *info = provenance_method(job->results->manifest, method);
    return info != NULL ? *info : (fm_method_info){ .id = method };
}
