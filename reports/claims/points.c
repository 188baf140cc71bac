#include "points.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "match.h"
#include "read/group.h"
#include "read/options.h"
#include "read/workload.h"

enum { SAMPLES_WANTED = 5 };
/* What timings scatter by from process to process where a processor does the work. */
static const double few_samples_share = 0.15;

/* ---- values ---- */

static bool is_time(const fm_text_list *metrics)
{
    for (size_t i = 0; i < metrics->count; i++) {
        if (strncmp(metrics->items[i], "fps", 3) == 0)
            return true;
        const size_t length = strlen(metrics->items[i]);
        if (length > 3 && strcmp(metrics->items[i] + length - 3, "_ms") == 0)
            return true;
    }
    return false;
}

static fm_interval widened(fm_interval value)
{
    value.low = fmin(value.low, value.median * (1.0 - few_samples_share));
    value.high = fmax(value.high, value.median * (1.0 + few_samples_share));
    return value;
}

static fm_interval measured_value(bool *has_few, const fm_claim_selection *selection,
                                  const fm_claim_rows *rows, const fm_case_row *result)
{
    size_t samples = 0;
    fm_interval value =
        result_files_interval(&samples, rows->results, result, text_list_items(&selection->metrics),
                              selection->metrics.count);
    if (samples == 0)
        samples = isnan(result->samples) ? 0 : (size_t)result->samples;
    const bool is_single = result->is_software && result->launches < 2.0;
    if (!is_time(&selection->metrics) || (samples >= SAMPLES_WANTED && !is_single))
        return value;
    *has_few = true;
    return widened(value);
}

static fm_interval formula_value(const fm_claim_selection *selection, const fm_case_row *result)
{
    const double pixels = result->width_px * result->height_px;
    const double factors[FM_FORMULA_TERMS] = { 1.0, pixels, pixels * result->k, pixels * result->n,
                                               result->fragments_generated };
    double sum = 0.0;
    for (int i = 0; i < FM_FORMULA_TERMS; i++)
        if (selection->formula[i] != 0.0)
            sum += selection->formula[i] * factors[i];
    return (fm_interval){ sum, sum, sum };
}

/* ---- points ---- */

typedef struct points_job {
    fm_claim_points *points;
    const fm_claim *claim;
    const fm_claim_rows *rows;
    size_t room;
} points_job;

/* A row of `of` gives no point: because of `result`, itself or the one it is compared with. */
static void note_missing(points_job *job, const fm_case_row *result, const char *why)
{
    if (job->points->missing_count++ > 0)
        return;
    snprintf(job->points->missing, sizeof job->points->missing, "%.60s%s%.12g: %.120s",
             result->look.title != NULL ? result->look.title : result->method,
             isnan(result->k) ? " n " : " k ", isnan(result->k) ? result->n : result->k, why);
}

/* Why a row has no value. */
static const char *why_missing(const fm_case_row *result)
{
    if (result->is_measured)
        return "no such metric";
    return result->message[0] != '\0' ? result->message : result->status;
}

/* Same method and options, but for what the other selection names itself. */
static bool is_own_partner(const fm_claim_selection *selection, const fm_case_row *of,
                           const fm_case_row *other)
{
    const fm_text_list *own = &selection->own_columns;
    if (!text_list_has(own, "method") && strcmp(of->method, other->method) != 0)
        return false;
    return text_list_has(own, "method") ||
           options_are_same(of->options, other->options, FM_OPTIONS_OWN, own);
}

/* Of several partners the greatest where the selection says so, else the least. */
static bool is_taken(const fm_claim_selection *selection, double value, double best)
{
    return selection->take == FM_TAKE_GREATEST ? value > best : value < best;
}

/* A row to compare with. */
typedef struct partner {
    const fm_case_row *result; /* NULL: no row has a value */
    const fm_case_row *failed; /* the first row that would be one if it had; may be NULL */
    fm_interval value;
    bool has_few_samples;
} partner;

/* The row of `selection` for the workload of `subject`. */
static partner find_partner(const points_job *job, const fm_claim_selection *selection,
                            const fm_case_row *subject)
{
    partner best = { 0 };
    const fm_text_list *own = &selection->own_columns;
    for (size_t i = 0; i < job->rows->results->count; i++) {
        partner one = { .result = &job->rows->results->cases[i] };
        if (!match_takes(job->claim, job->rows, i) || !match_row(selection, job->rows, i) ||
            !workload_same(subject, one.result, own) ||
            !is_own_partner(selection, subject, one.result))
            continue;
        one.value = measured_value(&one.has_few_samples, selection, job->rows, one.result);
        one.failed = best.failed;
        if (!isfinite(one.value.median))
            best.failed = best.failed != NULL ? best.failed : one.result;
        else if (best.result == NULL || is_taken(selection, one.value.median, best.value.median))
            best = one;
    }
    return best;
}

/* One operand for the point's row; false: there is none. */
static bool operand(fm_interval *value, fm_claim_point *point, points_job *job,
                    const fm_claim_selection *selection)
{
    if (selection->is_formula) {
        *value = formula_value(selection, point->result);
        return isfinite(value->median);
    }
    const partner found = find_partner(job, selection, point->result);
    *value = found.value;
    point->other = found.result;
    point->has_few_samples |= found.has_few_samples;
    if (found.result != NULL)
        return true;
    if (found.failed != NULL)
        note_missing(job, found.failed, why_missing(found.failed));
    else
        note_missing(job, point->result, "nothing measured to compare it with");
    return false;
}

static double x_of(const points_job *job, const fm_case_row *result)
{
    if (job->claim->along[0] == '\0')
        return NAN;
    return result_files_place(job->rows->results, result, job->claim->along);
}

static bool evaluate(fm_claim_point *point, points_job *job, const fm_claim_selection *of)
{
    fm_interval other = { 0 };
    const fm_claim *claim = job->claim;
    point->x = x_of(job, point->result);
    if (claim->form == FM_CLAIM_IMAGES) {
        const bool is_paired = operand(&other, point, job, &claim->over);
        point->has_few_samples = false; /* no time is looked at */
        return is_paired;
    }
    point->value = measured_value(&point->has_few_samples, of, job->rows, point->result);
    if (!isfinite(point->value.median)) {
        note_missing(job, point->result, why_missing(point->result));
        return false;
    }
    if (claim->has_minus) {
        if (!operand(&other, point, job, &claim->minus))
            return false;
        point->value = interval_difference(point->value, other);
    }
    if (claim->has_over) {
        fm_interval less = { 0 };
        if ((claim->has_over_minus && !operand(&less, point, job, &claim->over_minus)) ||
            !operand(&other, point, job, &claim->over))
            return false;
        other = interval_difference(other, less);
        point->value = interval_ratio(point->value, other);
    }
    return isfinite(point->value.median);
}

/* With take: least or greatest, one point a workload. */
static void add_point(points_job *job, const fm_claim_selection *of, const fm_claim_point *point)
{
    fm_claim_points *to = job->points;
    for (size_t i = 0; i < to->count && of->take != FM_TAKE_EACH; i++) {
        fm_claim_point *old = &to->points[i];
        if (old->selection != point->selection || !workload_same(old->result, point->result, NULL))
            continue;
        const bool is_better = of->take == FM_TAKE_LEAST ? point->value.median < old->value.median
                                                         : point->value.median > old->value.median;
        if (is_better)
            *old = *point;
        return;
    }
    if (to->count < job->room)
        to->points[to->count++] = *point;
}

static void add_summary_points(points_job *job, size_t selection)
{
    const fm_claim_selection *of = &job->claim->of[selection];
    for (size_t i = 0; i < job->rows->results->count; i++) {
        fm_claim_point point = { .result = &job->rows->results->cases[i], .selection = selection };
        if (match_takes(job->claim, job->rows, i) && match_row(of, job->rows, i) &&
            evaluate(&point, job, of))
            add_point(job, of, &point);
    }
}

/* ---- memory.csv ---- */

static double memory_value(const fm_claim_selection *selection, const fm_claim_rows *rows,
                           size_t row)
{
    double sum = 0.0;
    for (size_t i = 0; i < selection->metrics.count; i++) {
        double value = NAN;
        table_number(&value, rows->memory, row,
                     table_column(rows->memory, selection->metrics.items[i]), NULL);
        sum += value;
    }
    return sum;
}

/* Of the same column of the paper's table, unless the selection names one; of the same row, if it
 * names nothing. */
static double memory_partner(const fm_claim_selection *selection, const fm_claim_rows *rows,
                             size_t row)
{
    const size_t workload = table_column(rows->memory, "workload");
    const fm_text_list *own = &selection->own_columns;
    double found = NAN;
    if (own->count == 0)
        return memory_value(selection, rows, row);
    for (size_t i = 0; i < rows->memory->row_count; i++) {
        if (!match_memory_row(selection, rows, i) ||
            (!text_list_has(own, "workload") &&
             strcmp(table_cell(rows->memory, i, workload),
                    table_cell(rows->memory, row, workload)) != 0))
            continue;
        const double value = memory_value(selection, rows, i);
        if (isnan(found) || is_taken(selection, value, found))
            found = value;
    }
    return found;
}

static void add_memory_points(points_job *job, size_t selection)
{
    const fm_claim_selection *of = &job->claim->of[selection];
    const fm_claim_rows *rows = job->rows;
    for (size_t row = 0; rows->memory != NULL && row < rows->memory->row_count; row++) {
        if (!match_memory_row(of, rows, row))
            continue;
        double value = memory_value(of, rows, row);
        if (job->claim->has_minus)
            value -= memory_partner(&job->claim->minus, rows, row);
        if (job->claim->has_over_minus)
            value /= memory_partner(&job->claim->over, rows, row) -
                     memory_partner(&job->claim->over_minus, rows, row);
        else if (job->claim->has_over)
            value /= memory_partner(&job->claim->over, rows, row);
        if (isfinite(value) && job->points->count < job->room)
            job->points->points[job->points->count++] = (fm_claim_point){
                .value = { value, value, value }, .x = NAN, .row = row, .selection = selection
            };
    }
}

/* ---- order and names ---- */

bool claim_point_same_workload(const fm_claim *claim, const fm_claim_point *a,
                               const fm_claim_point *b)
{
    if (a->result == NULL || b->result == NULL)
        return a->result == b->result;
    return workload_same(a->result, b->result,
                         claim->form == FM_CLAIM_ORDER ? &claim->of[b->selection].own_columns
                                                       : &claim->free_columns);
}

bool claim_point_same_series(const fm_claim *claim, const fm_claim_point *a,
                             const fm_claim_point *b)
{
    if (a->selection != b->selection || !claim_point_same_workload(claim, a, b))
        return false;
    return a->result == NULL || claim->of[a->selection].take != FM_TAKE_EACH ||
           (strcmp(a->result->method, b->result->method) == 0 &&
            options_are_same(a->result->options, b->result->options, FM_OPTIONS_OWN,
                             &claim->free_columns));
}

/* Brings the points of each series together, x rising: an insertion sort, which the few points of
 * a claim allow, for "same series" is no order. */
static void sort_points(const fm_claim *claim, fm_claim_points *points)
{
    for (size_t i = 1; i < points->count; i++) {
        const fm_claim_point point = points->points[i];
        size_t place = i;
        for (size_t j = 0; j < i; j++)
            if (claim_point_same_series(claim, &points->points[j], &point))
                place = j + 1;
        while (place > 0 && claim_point_same_series(claim, &points->points[place - 1], &point) &&
               points->points[place - 1].x > point.x)
            place--;
        memmove(points->points + place + 1, points->points + place,
                (i - place) * sizeof *points->points);
        points->points[place] = point;
    }
}

void claim_point_name(char name[160], const fm_claim_rows *rows, const bool *used_cases,
                      const fm_claim_point *point)
{
    char title[96];
    if (point->result == NULL) {
        snprintf(name, 160, "%.60s, %.60s",
                 table_cell(rows->memory, point->row, table_column(rows->memory, "title")),
                 table_cell(rows->memory, point->row, table_column(rows->memory, "workload")));
        return;
    }
    group_series_title(title, point->result, NULL);
    const size_t used = (size_t)snprintf(name, 160, "%.80s", title);
    workload_name(name + used, 160 - used, rows->results, used_cases, point->result);
}

fm_status claim_points_make(fm_claim_points *points, const fm_claim *claim,
                            const fm_claim_rows *rows, fm_error *err)
{
    const size_t memory_rows = rows->memory != NULL ? rows->memory->row_count : 0;
    *points = (fm_claim_points){ 0 };
    points_job job = { .points = points,
                       .claim = claim,
                       .rows = rows,
                       .room = claim->of_count * (rows->results->count + memory_rows) + 1 };
    points->points = calloc(job.room, sizeof *points->points);
    if (points->points == NULL)
        return fm_fail(err, FM_NO_MEMORY, "claim %s: %zu points", claim->id, job.room);
    for (size_t i = 0; i < claim->of_count; i++)
        if (claim->of[i].table == FM_SELECT_MEMORY)
            add_memory_points(&job, i);
        else
            add_summary_points(&job, i);
    sort_points(claim, points);
    return FM_OK;
}

void claim_points_free(fm_claim_points *points)
{
    free(points->points);
    *points = (fm_claim_points){ 0 };
}
