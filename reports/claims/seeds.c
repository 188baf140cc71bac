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

static bool differs_in_seed(const fm_claim *claim, const fm_claim_point *a, const fm_claim_point *b)
{
    if (a->result == NULL || b->result == NULL || a->selection != b->selection ||
        strcmp(a->result->seed, b->result->seed) == 0 ||
        !workload_same_of_any_seed(a->result, b->result, NULL))
        return false;
    return claim->of[a->selection].take != FM_TAKE_EACH ||
           (strcmp(a->result->method, b->result->method) == 0 &&
            options_are_same(a->result->options, b->result->options, FM_OPTIONS_OWN, NULL));
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

void seeds_join(fm_claim_points *points, const fm_claim *claim)
{
    double *values = calloc(points->count + 1, sizeof *values);
    if (seeds_stay_apart(claim)) {
        free(values);
        return;
    }
    points->failed |= values == NULL;
    for (size_t i = 0; i < points->count && !points->failed; i++)
        join_at(points, i, claim, values);
    free(values);
}
