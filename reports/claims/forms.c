#include "forms.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "curves.h"
#include "read/picture.h"
#include "seeds.h"

static fm_status judge_bound(judging *to, fm_error *err)
{
    (void)err;
    for (size_t i = 0; i < to->points->count; i++)
        judging_value(to, to->points->points[i].value, &to->points->points[i], NULL);
    return FM_OK;
}

static const char *seed_of(const fm_claim_point *point)
{
    return point->result != NULL && point->result->seed != NULL ? point->result->seed : "";
}

static bool is_first_of_seed(const fm_claim_points *points, size_t index)
{
    for (size_t i = 0; i < index; i++)
        if (strcmp(seed_of(&points->points[i]), seed_of(&points->points[index])) == 0)
            return false;
    return true;
}

/* The mean of the points of one seed; NULL: of all. */
static fm_interval mean_of(size_t *count, const fm_claim_points *points, const char *seed)
{
    fm_interval mean = { 0 };
    *count = 0;
    for (size_t i = 0; i < points->count; i++) {
        if (seed != NULL && strcmp(seed_of(&points->points[i]), seed) != 0)
            continue;
        mean.median += points->points[i].value.median;
        mean.low += points->points[i].value.low;
        mean.high += points->points[i].value.high;
        (*count)++;
    }
    mean.median /= (double)*count;
    mean.low /= (double)*count;
    mean.high /= (double)*count;
    return mean;
}

/* The mean of each seed; returns how many they are. range: from the least to the greatest. */
static size_t seed_means(double *values, fm_interval *range, const fm_claim_points *points)
{
    size_t seeds = 0, of_seed;
    *range = (fm_interval){ NAN, INFINITY, -INFINITY };
    for (size_t i = 0; i < points->count; i++) {
        if (!is_first_of_seed(points, i))
            continue;
        const double value = mean_of(&of_seed, points, seed_of(&points->points[i])).median;
        range->low = fmin(range->low, value);
        range->high = fmax(range->high, value);
        values[seeds++] = value;
    }
    return seeds;
}

static fm_status judge_mean(judging *to, fm_error *err)
{
    size_t count = 0;
    const fm_interval mean = mean_of(&count, to->points, NULL);
    fm_interval range;
    double *values = calloc(to->points->count, sizeof *values);
    if (values == NULL)
        return fm_fail(err, FM_NO_MEMORY, "claim %s: %zu points", to->claim->id, count);
    const size_t seeds = seed_means(values, &range, to->points);
    judging_value(to, seeds_widen(mean, values, seeds), NULL, NULL);
    free(values);
    if (seeds > 1)
        judging_note(to, "the mean of %zu; %zu seeds: %.4g to %.4g", count, seeds, range.low,
                     range.high);
    else
        judging_note(to, "the mean of %zu", count);
    return FM_OK;
}

/* Each point against the next selection's of the same workload; a selection that has none there is
 * passed over. */
static fm_status judge_order(judging *to, fm_error *err)
{
    const fm_claim_points *points = to->points;
    (void)err;
    for (size_t i = 0; i < points->count; i++) {
        size_t next = SIZE_MAX;
        for (size_t j = 0; j < points->count; j++) {
            const size_t selection = points->points[j].selection;
            if (selection > points->points[i].selection && selection < next &&
                claim_point_same_workload(to->claim, &points->points[i], &points->points[j]))
                next = selection;
        }
        for (size_t j = 0; j < points->count && next != SIZE_MAX; j++)
            if (points->points[j].selection == next &&
                claim_point_same_workload(to->claim, &points->points[i], &points->points[j]))
                judging_step(to, &points->points[i], &points->points[j]);
    }
    return FM_OK;
}

static fm_status judge_images(judging *to, fm_error *err)
{
    for (size_t i = 0; i < to->points->count; i++) {
        const fm_claim_point *point = &to->points->points[i];
        double apart;
        const fm_status status = picture_compare(&apart, to->rows->results->directory,
                                                 point->result->id, point->other->id, err);
        if (status == FM_UNSUPPORTED) {
            judging_skip(to, point, 1, "a picture was not kept");
            continue;
        }
        if (status != FM_OK)
            return status;
        judging_value(to, interval_exact(apart), point, NULL);
    }
    return FM_OK;
}

static fm_status judge_curves(judging *to, fm_error *err)
{
    (void)err;
    curves_judge(to);
    return FM_OK;
}

static fm_status (*const forms[FM_CLAIM_FORM_COUNT])(judging *to, fm_error *err) = {
    [FM_CLAIM_BOUND] = judge_bound,     [FM_CLAIM_ANY] = judge_bound,
    [FM_CLAIM_MEAN] = judge_mean,       [FM_CLAIM_ORDER] = judge_order,
    [FM_CLAIM_IMAGES] = judge_images,   [FM_CLAIM_MONOTONE] = judge_curves,
    [FM_CLAIM_CROSSING] = judge_curves, [FM_CLAIM_PEAK] = judge_curves,
    [FM_CLAIM_SLOPE] = judge_curves,    [FM_CLAIM_SPREAD] = judge_curves,
};

fm_status claim_judge(fm_verdict *verdict, const fm_claim *claim, const fm_claim_rows *rows,
                      const fm_claim_points *points, fm_error *err)
{
    judging to = { .claim = claim, .rows = rows, .points = points };
    judging_begin(&to);
    const fm_status status = forms[claim->form](&to, err);
    judging_end(verdict, &to);
    return status;
}
