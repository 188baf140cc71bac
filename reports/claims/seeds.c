#include "seeds.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "read/options.h"
#include "read/workload.h"

fm_interval seeds_widen(fm_interval mean, const double *values, size_t count)
{
    double sum = 0.0, squares = 0.0;
    if (count < 2)
        return mean;
    for (size_t i = 0; i < count; i++)
        sum += values[i];
    for (size_t i = 0; i < count; i++)
        squares += pow(values[i] - sum / (double)count, 2.0);
    const double half =
        stats_student(count - 1) * sqrt(squares / (double)(count - 1) / (double)count);
    return (fm_interval){ mean.median, mean.median - hypot(half, mean.median - mean.low),
                          mean.median + hypot(half, mean.high - mean.median) };
}

bool seeds_stay_apart(const fm_claim *claim)
{
    return claim->form == FM_CLAIM_MEAN || claim->form == FM_CLAIM_IMAGES || claim->is_required ||
           (claim->low == claim->high && claim->tolerance == 0.0);
}

static bool is_same_method(const fm_case_row *a, const fm_case_row *b)
{
    return strcmp(a->method, b->method) == 0 &&
           options_are_same(a->options, b->options, FM_OPTIONS_OWN, NULL);
}

/* One point, but for the seed. */
static bool is_same(const fm_claim *claim, const fm_claim_point *a, const fm_claim_point *b)
{
    return a->result != NULL && b->result != NULL && a->selection == b->selection &&
           workload_same_of_any_seed(a->result, b->result, NULL) &&
           (claim->of[a->selection].take != FM_TAKE_EACH || is_same_method(a->result, b->result));
}

static bool differs_in_seed(const fm_claim *claim, const fm_claim_point *a, const fm_claim_point *b)
{
    return is_same(claim, a, b) && strcmp(a->result->seed, b->result->seed) != 0;
}

/* values: room for the seeds of the point at `first`, which takes in what follows it. */
static void join_at(fm_claim_points *points, size_t first, const fm_claim *claim, double *values)
{
    fm_claim_point *point = &points->points[first];
    fm_interval sum = point->value;
    double x = point->x;
    size_t kept = first + 1, count = 1;
    values[0] = point->value.median;
    for (size_t i = first + 1; i < points->count; i++) {
        const fm_claim_point *other = &points->points[i];
        if (!differs_in_seed(claim, point, other)) {
            points->points[kept++] = *other;
            continue;
        }
        values[count++] = other->value.median;
        sum.median += other->value.median;
        sum.low += other->value.low;
        sum.high += other->value.high;
        x += other->x;
        point->is_incomplete |= other->is_incomplete;
    }
    const double n = (double)count;
    points->count = kept;
    point->x = x / n;
    point->value =
        seeds_widen((fm_interval){ sum.median / n, sum.low / n, sum.high / n }, values, count);
}

/* The point of which the row was to be another seed; NULL: there is none, or another method gave
 * one of the row's seed. */
static fm_claim_point *point_of_other_seeds(const fm_claim_points *points, const fm_claim *claim,
                                            const fm_claim_point *row)
{
    fm_claim_point *found = NULL;
    for (size_t i = 0; i < points->count; i++) {
        fm_claim_point *point = &points->points[i];
        if (!is_same(claim, point, row))
            continue;
        if (!differs_in_seed(claim, point, row))
            return NULL;
        found = found != NULL ? found : point;
    }
    return found;
}

/* Another seed of the lost row was counted before it. */
static bool is_counted(const fm_claim_points *points, const fm_claim *claim, size_t index)
{
    const fm_claim_point *row = &points->lost[index].point;
    for (size_t i = 0; i < index; i++)
        if (!points->lost[i].is_joined && differs_in_seed(claim, &points->lost[i].point, row) &&
            is_same_method(points->lost[i].point.result, row->result))
            return true;
    return false;
}

static void count_lost(fm_claim_points *points, const fm_claim *claim)
{
    const bool stay_apart = seeds_stay_apart(claim);
    bool is_first = true;
    for (size_t i = 0; i < points->lost_count; i++) {
        fm_claim_lost *lost = &points->lost[i];
        fm_claim_point *point =
            stay_apart ? NULL : point_of_other_seeds(points, claim, &lost->point);
        lost->is_joined = point != NULL;
        if (point != NULL) {
            point->is_incomplete = true;
            if (points->incomplete[0] == '\0')
                claim_points_reason(points->incomplete, lost->lacks, lost->why);
        } else if (stay_apart || !is_counted(points, claim, i)) {
            points->missing_count++;
            if (is_first)
                claim_points_reason(points->missing, lost->lacks, lost->why);
            is_first = false;
        }
    }
}

void seeds_join(fm_claim_points *points, const fm_claim *claim)
{
    count_lost(points, claim);
    if (seeds_stay_apart(claim))
        return;
    double *values = calloc(points->count + 1, sizeof *values);
    points->failed |= values == NULL;
    for (size_t i = 0; i < points->count && !points->failed; i++)
        join_at(points, i, claim, values);
    free(values);
}
