#include "forms.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "draw/pictures.h"
#include "judging.h"

const char *verdict_name(fm_verdict_kind kind)
{
    static const char *const names[FM_VERDICT_COUNT] = {
        [FM_VERDICT_HOLDS] = "holds",
        [FM_VERDICT_UNCLEAR] = "unclear",
        [FM_VERDICT_FAILS] = "fails",
        [FM_VERDICT_NOT_TESTABLE] = "not testable here",
    };
    return names[kind];
}

/* A bound of 0 is widened by the tolerance itself. */
static double slack(const fm_claim *claim, double bound)
{
    return bound == 0.0 ? claim->tolerance : claim->tolerance * fabs(bound);
}

void bounds_of(double bounds[2], const fm_claim *claim)
{
    bounds[0] = isinf(claim->low) ? claim->low : claim->low - slack(claim, claim->low);
    bounds[1] = isinf(claim->high) ? claim->high : claim->high + slack(claim, claim->high);
}

fm_verdict_kind bounds_judge(const fm_claim *claim, fm_interval value)
{
    double bounds[2];
    bounds_of(bounds, claim);
    if (value.low >= bounds[0] && value.high <= bounds[1])
        return FM_VERDICT_HOLDS;
    return value.high < bounds[0] || value.low > bounds[1] ? FM_VERDICT_FAILS : FM_VERDICT_UNCLEAR;
}

/* How far the median is from the nearest bound, as a share of it; below 0 outside. */
static double bounds_margin(const fm_claim *claim, double value)
{
    double margin = INFINITY;
    if (!isinf(claim->low))
        margin = (value - claim->low) / fmax(fabs(claim->low), 1e-9);
    if (!isinf(claim->high))
        margin = fmin(margin, (claim->high - value) / fmax(fabs(claim->high), 1e-9));
    return margin;
}

static void judge_value(judging *to, fm_interval value, const fm_claim_point *a,
                        const fm_claim_point *b)
{
    const decision made = { bounds_judge(to->claim, value), value,
                            bounds_margin(to->claim, value.median), a, b };
    judging_decide(to, &made);
}

static fm_status judge_bound(judging *to, fm_error *err)
{
    (void)err;
    for (size_t i = 0; i < to->points->count; i++)
        judge_value(to, to->points->points[i].value, &to->points->points[i], NULL);
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

/* Seeds are draws of the same inputs: their means scatter, and so, by Student's t, does what is
 * said of all. false: there is one seed, of which the interval says nothing. */
static bool widen_by_seeds(fm_interval *mean, fm_interval *range, size_t *seeds,
                           const fm_claim_points *points)
{
    double sum = 0.0, squares = 0.0;
    size_t of_seed;
    *range = (fm_interval){ mean->median, INFINITY, -INFINITY };
    *seeds = 0;
    for (size_t i = 0; i < points->count; i++) {
        if (!is_first_of_seed(points, i))
            continue;
        const double value = mean_of(&of_seed, points, seed_of(&points->points[i])).median;
        range->low = fmin(range->low, value);
        range->high = fmax(range->high, value);
        sum += value;
        squares += value * value;
        (*seeds)++;
    }
    if (*seeds < 2)
        return false;
    const double n = (double)*seeds, variance = fmax(squares - sum * sum / n, 0.0) / (n - 1.0);
    const double half = stats_student(*seeds - 1) * sqrt(variance / n);
    mean->low = mean->median - hypot(half, mean->median - mean->low);
    mean->high = mean->median + hypot(half, mean->high - mean->median);
    return true;
}

static fm_status judge_mean(judging *to, fm_error *err)
{
    size_t count = 0, seeds = 0;
    fm_interval mean = mean_of(&count, to->points, NULL), range;
    (void)err;
    const bool has_seeds = widen_by_seeds(&mean, &range, &seeds, to->points);
    judge_value(to, mean, NULL, NULL);
    if (has_seeds)
        judging_note(to, "the mean of %zu; %zu seeds: %.4g to %.4g", count, seeds, range.low,
                     range.high);
    else
        judging_note(to, "the mean of %zu", count);
    return FM_OK;
}

/* `next` must lie above `point` by `least`. */
static void judge_rise(judging *to, const fm_claim_point *point, const fm_claim_point *next,
                       double least)
{
    const fm_interval rise = interval_difference(next->value, point->value);
    decision made = { .measured = interval_ratio(next->value, point->value),
                      .a = point,
                      .b = next };
    if (point->value.median == 0.0)
        made.measured = next->value; /* a ratio to nothing says nothing */
    made.margin = rise.median / fmax(fabs(point->value.median), 1e-12);
    if (rise.low >= least)
        made.kind = FM_VERDICT_HOLDS;
    else
        made.kind = rise.high < least ? FM_VERDICT_FAILS : FM_VERDICT_UNCLEAR;
    judging_decide(to, &made);
}

/* `next` may lie below `point` by the tolerance only. */
static void judge_step(judging *to, const fm_claim_point *point, const fm_claim_point *next)
{
    judge_rise(to, point, next, -to->claim->tolerance * fabs(point->value.median));
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
                judge_step(to, &points->points[i], &points->points[j]);
    }
    return FM_OK;
}

static fm_status judge_images(judging *to, fm_error *err)
{
    for (size_t i = 0; i < to->points->count; i++) {
        const fm_claim_point *point = &to->points->points[i];
        double apart;
        const fm_status status = pictures_compare(&apart, to->rows->results->directory,
                                                  point->result->id, point->other->id, err);
        if (status == FM_UNSUPPORTED) {
            judging_note(to, "a picture was not kept");
            continue;
        }
        if (status != FM_OK)
            return status;
        judge_value(to, (fm_interval){ apart, apart, apart }, point, NULL);
    }
    return FM_OK;
}

/* ---- forms of a curve: [first, end) are its points, x rising ---- */

typedef struct curve {
    const fm_claim_point *points;
    size_t count;
} curve;

/* Small steps back, each within the tolerance, must not make a curve that goes nowhere hold. */
static void judge_monotone(judging *to, const curve *of)
{
    const fm_claim_point *first = &of->points[0], *last = &of->points[of->count - 1];
    judge_rise(to, to->claim->rises ? first : last, to->claim->rises ? last : first, DBL_TRUE_MIN);
    for (size_t i = 1; i < of->count; i++)
        if (to->claim->rises)
            judge_step(to, &of->points[i - 1], &of->points[i]);
        else
            judge_step(to, &of->points[i], &of->points[i - 1]);
}

/* Between two x by the values there; on a log scale where x allows. */
static double interpolate(double x0, double x1, double share)
{
    return x0 > 0.0 ? x0 * pow(x1 / x0, share) : x0 + share * (x1 - x0);
}

static double limit_of(const fm_claim_point *point, int which)
{
    return which < 0 ? point->value.low : which > 0 ? point->value.high : point->value.median;
}

/* Where the medians (which = 0) or limits first pass the level; -INFINITY: before the first point,
 * INFINITY: beyond the last. */
static double crossing_of(const judging *to, const curve *of, int which)
{
    const double sign = to->claim->rises ? 1.0 : -1.0;
    double before = sign * (limit_of(&of->points[0], which) - to->claim->level);
    if (before >= 0.0)
        return -INFINITY;
    for (size_t i = 1; i < of->count; i++) {
        const double after = sign * (limit_of(&of->points[i], which) - to->claim->level);
        if (after >= 0.0)
            return interpolate(of->points[i - 1].x, of->points[i].x, before / (before - after));
        before = after;
    }
    return INFINITY;
}

static fm_verdict_kind between_judge(const fm_claim *claim, fm_interval x)
{
    if (x.low >= claim->between[0] && x.high <= claim->between[1])
        return FM_VERDICT_HOLDS;
    return x.high < claim->between[0] || x.low > claim->between[1] ? FM_VERDICT_FAILS
                                                                   : FM_VERDICT_UNCLEAR;
}

static void judge_crossing(judging *to, const curve *of)
{
    const fm_claim *claim = to->claim;
    const double one = crossing_of(to, of, -1), other = crossing_of(to, of, 1);
    decision made = { .measured = { crossing_of(to, of, 0), fmin(one, other), fmax(one, other) },
                      .a = &of->points[0] };
    made.kind = between_judge(claim, made.measured);
    /* Beyond what was measured it may still be where the claim has it. */
    const double first = of->points[0].x, last = of->points[of->count - 1].x;
    const bool is_short = (made.measured.high == INFINITY && last < claim->between[1]) ||
                          (made.measured.low == -INFINITY && first > claim->between[0]);
    if (is_short && made.kind == FM_VERDICT_FAILS) {
        judging_note(to, "%s was measured from %.6g to %.6g only", claim->along, first, last);
        made.kind = FM_VERDICT_NOT_TESTABLE;
    }
    judging_decide(to, &made);
}

static bool is_better(const judging *to, double a, double b)
{
    return to->claim->wants_greatest ? a > b : a < b;
}

/* All x whose interval reaches the best point's may be the peak. */
static void judge_peak(judging *to, const curve *of)
{
    const fm_claim_point *best = &of->points[0];
    for (size_t i = 1; i < of->count; i++)
        if (is_better(to, of->points[i].value.median, best->value.median))
            best = &of->points[i];
    decision made = { .measured = { best->x, best->x, best->x }, .a = best };
    for (size_t i = 0; i < of->count; i++) {
        const fm_interval *value = &of->points[i].value;
        const bool reaches = to->claim->wants_greatest ? value->high >= best->value.low
                                                       : value->low <= best->value.high;
        if (!reaches)
            continue;
        made.measured.low = fmin(made.measured.low, of->points[i].x);
        made.measured.high = fmax(made.measured.high, of->points[i].x);
    }
    made.kind = between_judge(to->claim, made.measured);
    judging_decide(to, &made);
}

/* Least squares: the slope is a weighted sum of the values, and so is its uncertainty. */
static fm_interval slope_of(const judging *to, const curve *of)
{
    const bool is_log = !to->claim->is_linear;
    double x_mean = 0.0, y_mean = 0.0, weight = 0.0, slope = 0.0, below = 0.0, above = 0.0;
    for (size_t i = 0; i < of->count; i++) {
        x_mean += (is_log ? log(of->points[i].x) : of->points[i].x) / (double)of->count;
        y_mean += of->points[i].value.median / (double)of->count;
    }
    for (size_t i = 0; i < of->count; i++)
        weight += pow((is_log ? log(of->points[i].x) : of->points[i].x) - x_mean, 2.0);
    const double scale = is_log ? 1.0 : x_mean / y_mean;
    for (size_t i = 0; i < of->count; i++) {
        const fm_interval *value = &of->points[i].value;
        const double share =
            ((is_log ? log(of->points[i].x) : of->points[i].x) - x_mean) / weight * scale;
        const double up = is_log ? log(value->high / value->median) : value->high - value->median;
        const double down = is_log ? log(value->median / value->low) : value->median - value->low;
        slope += share * (is_log ? log(value->median) : value->median);
        above += pow(share * (share > 0.0 ? up : down), 2.0);
        below += pow(share * (share > 0.0 ? down : up), 2.0);
    }
    return (fm_interval){ slope, slope - sqrt(below), slope + sqrt(above) };
}

static void judge_slope(judging *to, const curve *of)
{
    const fm_interval slope = slope_of(to, of);
    if (isfinite(slope.median))
        judge_value(to, slope, &of->points[0], &of->points[of->count - 1]);
    else
        judging_note(to, "no slope: values or %s are not positive, or all the same",
                     to->claim->along);
}

static void judge_spread(judging *to, const curve *of)
{
    const fm_claim_point *least = &of->points[0], *greatest = &of->points[0];
    for (size_t i = 1; i < of->count; i++) {
        if (of->points[i].value.median < least->value.median)
            least = &of->points[i];
        if (of->points[i].value.median > greatest->value.median)
            greatest = &of->points[i];
    }
    judge_value(to, interval_ratio(greatest->value, least->value), greatest, least);
}

static const struct {
    fm_status (*points)(judging *to, fm_error *err);
    void (*curve)(judging *to, const curve *of);
    size_t points_needed; /* of a curve */
} forms[FM_CLAIM_FORM_COUNT] = {
    [FM_CLAIM_BOUND] = { .points = judge_bound },
    [FM_CLAIM_ANY] = { .points = judge_bound },
    [FM_CLAIM_MEAN] = { .points = judge_mean },
    [FM_CLAIM_ORDER] = { .points = judge_order },
    [FM_CLAIM_IMAGES] = { .points = judge_images },
    [FM_CLAIM_MONOTONE] = { .curve = judge_monotone, .points_needed = 2 },
    [FM_CLAIM_CROSSING] = { .curve = judge_crossing, .points_needed = 2 },
    [FM_CLAIM_PEAK] = { .curve = judge_peak, .points_needed = 3 },
    [FM_CLAIM_SLOPE] = { .curve = judge_slope, .points_needed = 2 },
    [FM_CLAIM_SPREAD] = { .curve = judge_spread, .points_needed = 2 },
};

static void judge_curves(judging *to)
{
    const fm_claim_points *points = to->points;
    const size_t needed = forms[to->claim->form].points_needed;
    size_t end;
    for (size_t first = 0; first < points->count; first = end) {
        end = first + 1;
        while (end < points->count &&
               claim_point_same_series(to->claim, &points->points[first], &points->points[end]))
            end++;
        const curve of = { &points->points[first], end - first };
        if (of.count >= needed)
            forms[to->claim->form].curve(to, &of);
        else
            judging_note(to, "only %zu of the %zu points that a curve needs", of.count, needed);
    }
}

fm_status claim_judge(fm_verdict *verdict, const fm_claim *claim, const fm_claim_rows *rows,
                      const fm_claim_points *points, fm_error *err)
{
    fm_status status = FM_OK;
    judging to = { .claim = claim, .rows = rows, .points = points };
    judging_begin(&to);
    if (forms[claim->form].points != NULL)
        status = forms[claim->form].points(&to, err);
    else
        judge_curves(&to);
    judging_end(verdict, &to);
    return status;
}
