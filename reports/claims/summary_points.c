#include "summary_points.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "read/case_metrics.h"
#include "read/options.h"
#include "read/workload.h"
#include "values.h"

typedef struct points_job {
    fm_claim_points *points;
    const fm_claim *claim;
    const fm_claim_rows *rows;
} points_job;

/* A row of `of` gives no point: because of `result`, itself or the one it is compared with. */
static void note_missing(points_job *job, const fm_claim_point *point, const fm_case_row *result,
                         const char *why)
{
    claim_points_lose(job->points,
                      &(fm_claim_lost){ .point = *point, .lacks = result, .why = why });
}

/* One of several rows that the point is compared with has no value. */
static void note_incomplete(points_job *job, fm_claim_point *point, const fm_case_row *result,
                            const char *why)
{
    point->is_incomplete = true;
    if (job->points->incomplete[0] == '\0')
        claim_points_reason(job->points->incomplete, result, why);
}

/* Why a row has no value. */
static const char *why_missing(const fm_case_row *result)
{
    if (result->is_measured)
        return "no such metric";
    return result->message[0] != '\0' ? result->message : result->status;
}

/* Same method and options, but for what the other selection names itself. */
static bool is_own_partner(const fm_claim_selection *selection, const fm_case_row *subject,
                           const fm_case_row *other)
{
    const fm_text_list *own = &selection->own_columns;
    if (!text_list_has(own, "method") && strcmp(subject->method, other->method) != 0)
        return false;
    return text_list_has(own, "method") ||
           options_are_same(subject->options, other->options, FM_OPTIONS_OWN, own);
}

/* A row to compare with. */
typedef struct partner {
    const fm_case_row *result; /* NULL: no row has a value */
    const fm_case_row *failed; /* the first row that would be one if it had; may be NULL */
    fm_interval value;
} partner;

/* Row i may be what `subject` is compared with. */
static bool is_candidate(const points_job *job, const fm_claim_selection *selection,
                         const fm_case_row *subject, size_t i)
{
    const fm_case_row *other = &job->rows->results->cases[i];
    return match_takes(job->claim, job->rows, i) && match_row(selection, job->rows, i) &&
           workload_same(subject, other, &selection->own_columns) &&
           is_own_partner(selection, subject, other);
}

/* The row of `selection` for the workload of `subject`. */
static partner find_partner(const points_job *job, const fm_claim_selection *selection,
                            const fm_case_row *subject)
{
    partner best = { 0 };
    for (size_t i = 0; i < job->rows->results->count; i++) {
        partner one = { .result = &job->rows->results->cases[i] };
        if (!is_candidate(job, selection, subject, i))
            continue;
        one.value = value_measured(selection, job->rows, one.result);
        one.failed = best.failed;
        if (!isfinite(one.value.median))
            best.failed = best.failed != NULL ? best.failed : one.result;
        else if (best.result == NULL ||
                 value_is_taken(selection, one.value.median, best.value.median))
            best = one;
    }
    return best;
}

static bool has_value(const points_job *job, const fm_claim_selection *selection, size_t i)
{
    return isfinite(value_measured(selection, job->rows, &job->rows->results->cases[i]).median);
}

/* Of several methods to compare with, a row of one that has no value with any of its options; NULL:
 * each has one. */
static const fm_case_row *lacking(const points_job *job, const fm_claim_selection *selection,
                                  const fm_case_row *subject)
{
    const fm_case_row *cases = job->rows->results->cases;
    const size_t count = job->rows->results->count;
    for (size_t i = 0; i < count; i++) {
        if (!is_candidate(job, selection, subject, i) || has_value(job, selection, i))
            continue;
        bool is_found = false;
        for (size_t j = 0; j < count && !is_found; j++)
            is_found = strcmp(cases[i].method, cases[j].method) == 0 &&
                       is_candidate(job, selection, subject, j) && has_value(job, selection, j);
        if (!is_found)
            return &cases[i];
    }
    return NULL;
}

/* One operand for the point's row; false: there is none. */
static bool operand(fm_interval *value, fm_claim_point *point, points_job *job,
                    const fm_claim_selection *selection)
{
    if (selection->is_formula) {
        *value = value_by_formula(selection, point->result);
        if (!isfinite(value->median))
            note_missing(job, point, point->result, "lacks a number of the formula");
        return isfinite(value->median);
    }
    const partner found = find_partner(job, selection, point->result);
    *value = found.value;
    point->other = found.result;
    const fm_case_row *lacks = found.failed != NULL ? lacking(job, selection, point->result) : NULL;
    if (found.result != NULL && lacks != NULL)
        note_incomplete(job, point, lacks, why_missing(lacks));
    if (found.result != NULL)
        return true;
    if (found.failed != NULL)
        note_missing(job, point, found.failed, why_missing(found.failed));
    else
        note_missing(job, point, point->result, "nothing measured to compare it with");
    return false;
}

static double x_of(const points_job *job, const fm_case_row *result)
{
    if (job->claim->along[0] == '\0')
        return NAN;
    return case_place(job->rows->results, result, job->claim->along);
}

static bool evaluate(fm_claim_point *point, points_job *job, const fm_claim_selection *selection)
{
    fm_interval other = { 0 };
    const fm_claim *claim = job->claim;
    point->x = x_of(job, point->result);
    if (claim->form == FM_CLAIM_IMAGES)
        return operand(&other, point, job, &claim->over);
    point->value = value_measured(selection, job->rows, point->result);
    if (!isfinite(point->value.median)) {
        note_missing(job, point, point->result, why_missing(point->result));
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
    if (!isfinite(point->value.median))
        note_missing(job, point, point->result, "divided by 0");
    return isfinite(point->value.median);
}

/* With take: least or greatest, one point a workload. */
static void add_point(fm_claim_points *to, const fm_claim_selection *selection,
                      const fm_claim_point *point)
{
    for (size_t i = 0; i < to->count && selection->take != FM_TAKE_EACH; i++) {
        fm_claim_point *old = &to->points[i];
        if (old->selection != point->selection || !workload_same(old->result, point->result, NULL))
            continue;
        const bool is_better = selection->take == FM_TAKE_LEAST
                                   ? point->value.median < old->value.median
                                   : point->value.median > old->value.median;
        if (is_better)
            *old = *point;
        return;
    }
    claim_points_add(to, point);
}

static bool has_method(const points_job *job, const char *method)
{
    for (size_t i = 0; i < job->rows->results->count; i++)
        if (match_takes(job->claim, job->rows, i) &&
            strcmp(job->rows->results->cases[i].method, method) == 0)
            return true;
    return false;
}

/* Of the methods that the selection itself names, one that no row here is of; NULL: there is none.
 * *count: how many they are. */
static const char *absent_method(size_t *count, const points_job *job,
                                 const fm_claim_selection *selection)
{
    const char *first = NULL;
    *count = 0;
    for (size_t i = 0; i < selection->test_count; i++) {
        const fm_yaml *value = selection->tests[i].value;
        if (strcmp(selection->tests[i].key, "method") != 0 || value->kind != FM_YAML_LIST ||
            !text_list_has(&selection->own_columns, "method"))
            continue;
        for (size_t j = 0; j < value->count; j++)
            if (!has_method(job, value->items[j].text)) {
                first = first != NULL ? first : value->items[j].text;
                (*count)++;
            }
    }
    return first;
}

/* What a claim says of several methods does not hold as a whole where one of them was not run. */
static void note_absent(points_job *job, const fm_claim_selection *selection)
{
    const fm_claim *claim = job->claim;
    const struct {
        bool is_there;
        const fm_claim_selection *selection;
    } others[] = { { claim->has_minus, &claim->minus },
                   { claim->has_over, &claim->over },
                   { claim->has_over_minus, &claim->over_minus } };
    size_t count;
    const char *absent = absent_method(&count, job, selection);
    if (absent != NULL && job->points->missing_count == 0)
        snprintf(job->points->missing, sizeof job->points->missing, "no case of %.60s", absent);
    job->points->missing_count += count;
    for (size_t i = 0; i < sizeof others / sizeof others[0]; i++) {
        absent = others[i].is_there ? absent_method(&count, job, others[i].selection) : NULL;
        if (absent == NULL)
            continue;
        for (size_t j = 0; j < job->points->count; j++)
            job->points->points[j].is_incomplete = true;
        if (job->points->incomplete[0] == '\0')
            snprintf(job->points->incomplete, sizeof job->points->incomplete, "no case of %.60s",
                     absent);
    }
}

void summary_points_add(fm_claim_points *points, const fm_claim *claim, const fm_claim_rows *rows,
                        size_t index)
{
    points_job job = { .points = points, .claim = claim, .rows = rows };
    const fm_claim_selection *selection = &claim->of[index];
    for (size_t i = 0; i < rows->results->count; i++) {
        fm_claim_point point = { .result = &rows->results->cases[i], .selection = index };
        if (match_takes(claim, rows, i) && match_row(selection, rows, i) &&
            evaluate(&point, &job, selection))
            add_point(points, selection, &point);
    }
    if (points->count > 0)
        note_absent(&job, selection);
}
