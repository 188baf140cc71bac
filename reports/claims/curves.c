#include "curves.h"

#include <float.h>
#include <math.h>

typedef struct curve {
    const fm_claim_point *points;
    size_t count;
} curve;

/* Small steps back, each within the tolerance, must not make a curve that goes nowhere hold. */
static void judge_monotone(judging *to, const curve *line)
{
    const fm_claim_point *first = &line->points[0], *last = &line->points[line->count - 1];
    judging_rise(to, to->claim->rises ? first : last, to->claim->rises ? last : first,
                 DBL_TRUE_MIN);
    for (size_t i = 1; i < line->count; i++)
        if (to->claim->rises)
            judging_step(to, &line->points[i - 1], &line->points[i]);
        else
            judging_step(to, &line->points[i], &line->points[i - 1]);
}

/* Between two x by the values there; on a log scale where x allows. */
static double interpolate(double x0, double x1, double share)
{
    return x0 > 0.0 ? x0 * pow(x1 / x0, share) : x0 + share * (x1 - x0);
}

/* Whether all points have an interval; if one lacks it, nothing is known of where a curve goes. */
static bool is_known(const curve *line)
{
    for (size_t i = 0; i < line->count; i++)
        if (!interval_is_known(&line->points[i].value))
            return false;
    return true;
}

static double limit_of(const fm_claim_point *point, int which)
{
    return which < 0 ? point->value.low : which > 0 ? point->value.high : point->value.median;
}

/* Where the medians (which = 0) or limits first pass the level; -INFINITY: before the first point,
 * INFINITY: beyond the last. */
static double crossing_of(const judging *to, const curve *line, int which)
{
    const double sign = to->claim->rises ? 1.0 : -1.0;
    double before = sign * (limit_of(&line->points[0], which) - to->claim->level);
    if (before >= 0.0)
        return -INFINITY;
    for (size_t i = 1; i < line->count; i++) {
        const double after = sign * (limit_of(&line->points[i], which) - to->claim->level);
        if (after >= 0.0)
            return interpolate(line->points[i - 1].x, line->points[i].x, before / (before - after));
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

static void judge_crossing(judging *to, const curve *line)
{
    const fm_claim *claim = to->claim;
    const double one = crossing_of(to, line, -1), other = crossing_of(to, line, 1);
    decision made = { .measured = { crossing_of(to, line, 0), fmin(one, other), fmax(one, other) },
                      .a = &line->points[0] };
    if (!is_known(line))
        made.measured.low = made.measured.high = NAN;
    made.kind = between_judge(claim, made.measured);
    /* Beyond what was measured it may still be where the claim has it. */
    const double first = line->points[0].x, last = line->points[line->count - 1].x;
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
static void judge_peak(judging *to, const curve *line)
{
    const fm_claim_point *best = &line->points[0];
    for (size_t i = 1; i < line->count; i++)
        if (is_better(to, line->points[i].value.median, best->value.median))
            best = &line->points[i];
    decision made = { .measured = interval_exact(best->x), .a = best };
    for (size_t i = 0; i < line->count; i++) {
        const fm_interval *value = &line->points[i].value;
        const bool reaches = to->claim->wants_greatest ? value->high >= best->value.low
                                                       : value->low <= best->value.high;
        if (!reaches)
            continue;
        made.measured.low = fmin(made.measured.low, line->points[i].x);
        made.measured.high = fmax(made.measured.high, line->points[i].x);
    }
    if (!is_known(line))
        made.measured.low = made.measured.high = NAN;
    made.kind = between_judge(to->claim, made.measured);
    judging_decide(to, &made);
}

/* Least squares: the slope is a weighted sum of the values, and so is its uncertainty. */
static fm_interval slope_of(const judging *to, const curve *line)
{
    const bool is_log = !to->claim->is_linear;
    double x_mean = 0.0, y_mean = 0.0, weight = 0.0, slope = 0.0, below = 0.0, above = 0.0;
    for (size_t i = 0; i < line->count; i++) {
        x_mean += (is_log ? log(line->points[i].x) : line->points[i].x) / (double)line->count;
        y_mean += line->points[i].value.median / (double)line->count;
    }
    for (size_t i = 0; i < line->count; i++)
        weight += pow((is_log ? log(line->points[i].x) : line->points[i].x) - x_mean, 2.0);
    const double scale = is_log ? 1.0 : x_mean / y_mean;
    for (size_t i = 0; i < line->count; i++) {
        const fm_interval *value = &line->points[i].value;
        const double share =
            ((is_log ? log(line->points[i].x) : line->points[i].x) - x_mean) / weight * scale;
        const double up = is_log ? log(value->high / value->median) : value->high - value->median;
        const double down = is_log ? log(value->median / value->low) : value->median - value->low;
        slope += share * (is_log ? log(value->median) : value->median);
        above += pow(share * (share > 0.0 ? up : down), 2.0);
        below += pow(share * (share > 0.0 ? down : up), 2.0);
    }
    return (fm_interval){ slope, slope - sqrt(below), slope + sqrt(above) };
}

static void judge_slope(judging *to, const curve *line)
{
    const fm_interval slope = slope_of(to, line);
    if (isfinite(slope.median))
        judging_value(to, slope, &line->points[0], &line->points[line->count - 1]);
    else
        judging_skip(to, line->points, line->count,
                     "no slope: values or %s are not positive, or all the same", to->claim->along);
}

static void judge_spread(judging *to, const curve *line)
{
    const fm_claim_point *least = &line->points[0], *greatest = &line->points[0];
    for (size_t i = 1; i < line->count; i++) {
        if (line->points[i].value.median < least->value.median)
            least = &line->points[i];
        if (line->points[i].value.median > greatest->value.median)
            greatest = &line->points[i];
    }
    judging_value(to, interval_ratio(greatest->value, least->value), greatest, least);
}

/* What a curve is judged by, and how many points it must have. */
static const struct {
    void (*judge)(judging *to, const curve *line);
    size_t points_needed;
} forms[FM_CLAIM_FORM_COUNT] = {
    [FM_CLAIM_MONOTONE] = { judge_monotone, 2 }, [FM_CLAIM_CROSSING] = { judge_crossing, 2 },
    [FM_CLAIM_PEAK] = { judge_peak, 3 },         [FM_CLAIM_SLOPE] = { judge_slope, 2 },
    [FM_CLAIM_SPREAD] = { judge_spread, 2 },
};

void curves_judge(judging *to)
{
    const fm_claim_points *points = to->points;
    const size_t needed = forms[to->claim->form].points_needed;
    size_t end;
    for (size_t first = 0; first < points->count; first = end) {
        end = first + 1;
        while (end < points->count &&
               claim_point_same_series(to->claim, &points->points[first], &points->points[end]))
            end++;
        const curve line = { &points->points[first], end - first };
        if (line.count >= needed)
            forms[to->claim->form].judge(to, &line);
        else
            judging_skip(to, line.points, line.count,
                         "only %zu of the %zu points that a curve needs", line.count, needed);
    }
}
