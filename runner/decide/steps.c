#include "steps.h"

#include <math.h>
#include <stdlib.h>

/* A series while it is parted. */
typedef struct search {
    const double *values;
    double *p; /* [count]: of the places of one part */
    double level_per_value;
    size_t least;
    fm_step *steps;
    size_t count;
    fm_error *err;
} search;

/* The most likely place in values[first .. end); `end`: none counts. */
static fm_status find_place(size_t *place, double *p_adjusted, search *in, size_t first, size_t end)
{
    const size_t count = end - first;
    *place = end;
    if (count < 2 * in->least)
        return FM_OK;
    const fm_status status = rank_sum_splits(in->p, in->values + first, count, in->err);
    if (status != FM_OK)
        return status;
    size_t best = in->least;
    for (size_t i = in->least; i <= count - in->least; i++)
        if (in->p[i] < in->p[best])
            best = i;
    *p_adjusted = fmin(1.0, in->p[best] * (double)(count - 2 * in->least + 1));
    if (*p_adjusted <= in->level_per_value * (double)count)
        *place = first + best;
    return FM_OK;
}

/* In order: what is before a step, the step, what is behind it. Parts become shorter, so that this
 * ends. */
static fm_status part(search *in, size_t first, size_t end)
{
    size_t place;
    double p_adjusted;
    fm_status status = find_place(&place, &p_adjusted, in, first, end);
    if (status != FM_OK || place == end)
        return status;
    status = part(in, first, place);
    in->steps[in->count++] = (fm_step){ .index = place, .p_adjusted = p_adjusted };
    return status == FM_OK ? part(in, place, end) : status;
}

/* Between the steps beside each of them. */
static fm_status find_shifts(search *in, size_t count)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < in->count && status == FM_OK; i++) {
        fm_rank_sum test;
        const size_t first = i > 0 ? in->steps[i - 1].index : 0;
        const size_t end = i + 1 < in->count ? in->steps[i + 1].index : count;
        status = rank_sum_test(&test, in->values + first, in->steps[i].index - first, end - first,
                               in->err);
        in->steps[i].shift = test.shift;
    }
    return status;
}

fm_status steps_find(fm_step *steps, size_t *step_count, const double *values, size_t count,
                     const fm_steps_desc *desc, fm_error *err)
{
    search in = {
        .values = values, .least = desc->least > 0 ? desc->least : 3, .steps = steps, .err = err
    };
    *step_count = 0;
    fm_status status = decide_check(values, count, err);
    if (status != FM_OK)
        return status;
    if (count > RANK_SUM_VALUES || !(desc->level > 0.0 && desc->level < 1.0))
        return fm_fail(err, FM_INVALID, "%zu values at level %g: at most %d, between 0 and 1",
                       count, desc->level, RANK_SUM_VALUES);
    in.level_per_value = desc->level / (double)count;
    in.p = calloc(count, sizeof *in.p);
    if (in.p == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu values", count);
    status = part(&in, 0, count);
    if (status == FM_OK)
        status = find_shifts(&in, count);
    free(in.p);
    *step_count = status == FM_OK ? in.count : 0;
    return status;
}
