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
static void note_missing(points_job *job, const fm_case_row *result, const char *why)
{
    if (job->points->missing_count++ > 0)
        return;
    snprintf(job->points->missing, sizeof job->points->missing, "%.60s%s%.12g: %.120s",
             result->look.title != NULL ? result->look.title : result->method,
             isnan(result->k) ? " n " : " k ",
             isnan(result->k) ? result->metric[FM_METRIC_N] : result->k, why);
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

/* One operand for the point's row; false: there is none. */
static bool operand(fm_interval *value, fm_claim_point *point, points_job *job,
                    const fm_claim_selection *selection)
{
    if (selection->is_formula) {
        *value = value_by_formula(selection, point->result);
        return isfinite(value->median);
    }
    const partner found = find_partner(job, selection, point->result);
    *value = found.value;
    point->other = found.result;
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
}
