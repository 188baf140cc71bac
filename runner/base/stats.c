#include "stats.h"

#include <math.h>
#include <stdlib.h>

static const double usual_coverage = 0.95;

/* NAN sorts last, so that the order is total and qsort stays defined. */
static int compare_doubles(const void *left, const void *right)
{
    const double a = *(const double *)left, b = *(const double *)right;
    if (isnan(a) || isnan(b))
        return (int)(isnan(a) != 0) - (int)(isnan(b) != 0);
    return (a > b) - (a < b);
}

void stats_sort(double *values, size_t count)
{
    if (count > 0) /* qsort may be handed no NULL */
        qsort(values, count, sizeof *values, compare_doubles);
}

double stats_median(double *values, size_t count)
{
    if (count == 0)
        return NAN;
    stats_sort(values, count);
    const size_t middle = count / 2;
    return count % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

fm_interval interval_exact(double value)
{
    return (fm_interval){ value, value, value };
}

bool interval_is_known(const fm_interval *interval)
{
    return !isnan(interval->low) && !isnan(interval->high);
}

/* How far the range of 2 to 4 values of a normal distribution must be widened to each side, as a
 * share of itself, to hold its median 95 times of 100: what widening_of computes, in advance. That
 * of 5 holds it 93.75 times, whatever the distribution, and stays. */
static const double usual_widening[] = { [2] = 5.85, [3] = 0.815, [4] = 0.239, [5] = 0.0 };
enum { WIDENED_MOST = sizeof usual_widening / sizeof usual_widening[0] - 1 };

/* How likely the median lies between the rank-th least and the rank-th greatest of `count`. */
static double coverage_of_rank(size_t count, size_t rank)
{
    const double n = (double)count;
    double outside = 0.0;
    for (size_t i = 0; i < rank; i++)
        outside += exp(lgamma(n + 1.0) - lgamma((double)i + 1.0) - lgamma(n - (double)i + 1.0) -
                       n * log(2.0));
    return 1.0 - 2.0 * outside;
}

/* Whether the least and the greatest hold the median as often as that. */
static bool ranks_suffice(size_t count, double coverage)
{
    return coverage_of_rank(count, 1) >= coverage;
}

/* Between ranks. */
static void interpolate_ends(double *low, double *high, const double *sorted, size_t count,
                             double coverage)
{
    size_t rank = 1;
    while (coverage_of_rank(count, rank + 1) >= coverage)
        rank++;
    const double n = (double)count, r = (double)rank;
    const double outer = coverage_of_rank(count, rank), inner = coverage_of_rank(count, rank + 1);
    const double share = (outer - coverage) / (outer - inner);
    const double weight = (n - r) * share / (r + (n - 2.0 * r) * share);
    *low = (1.0 - weight) * sorted[rank - 1] + weight * sorted[rank];
    *high = (1.0 - weight) * sorted[count - rank] + weight * sorted[count - rank - 1];
}

static double normal_below(double x)
{
    return 0.5 * erfc(-x / sqrt(2.0));
}

/* How likely the range of `count` normal values, widened by that share, misses their median on one
 * side: the least is at x > 0, and all others lie between it and x (1 + 1 / widening). By Simpson's
 * rule; beyond 8 there is nothing. */
static double miss_of_widened(size_t count, double widening)
{
    enum { STEPS = 128 };
    const double step = 8.0 / STEPS, n = (double)count;
    double sum = 0.0;
    for (int i = 0; i <= STEPS; i++) {
        const double x = i * step, weight = i == 0 || i == STEPS ? 1.0 : i % 2 == 1 ? 4.0 : 2.0;
        const double density = exp(-0.5 * x * x) / sqrt(2.0 * acos(-1.0));
        const double others = normal_below(x * (1.0 + 1.0 / widening)) - normal_below(x);
        sum += weight * n * density * pow(others, n - 1.0);
    }
    return sum * step / 3.0;
}

/* The share by which the range of normal values has to be widened to hold their median so often. */
static double widening_of(size_t count, double coverage)
{
    enum { HALVINGS = 40 };
    double low = 1e-3, high = 1e6; /* halved by their logarithms */
    if (coverage <= usual_coverage && count <= WIDENED_MOST)
        return usual_widening[count];
    for (int i = 0; i < HALVINGS; i++) {
        const double middle = sqrt(low * high);
        if (2.0 * miss_of_widened(count, middle) > 1.0 - coverage)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* Beyond the least and the greatest of sorted values. */
static void widen_ends(double *low, double *high, const double *sorted, size_t count,
                       double widening)
{
    const double least = sorted[0], greatest = sorted[count - 1];
    if (least > 0.0) {
        const double factor = pow(greatest / least, widening);
        *low = least / factor;
        *high = greatest * factor;
        return;
    }
    *low = least - widening * (greatest - least);
    *high = greatest + widening * (greatest - least);
}

fm_interval stats_interval_at(double *values, size_t count, double coverage)
{
    fm_interval interval = { stats_median(values, count), NAN, NAN }; /* now they are sorted */
    if (count < 2 || isnan(interval.median))
        return interval;
    if (ranks_suffice(count, coverage))
        interpolate_ends(&interval.low, &interval.high, values, count, coverage);
    else
        widen_ends(&interval.low, &interval.high, values, count, widening_of(count, coverage));
    return interval;
}

fm_interval stats_interval(double *values, size_t count)
{
    return stats_interval_at(values, count, usual_coverage);
}

/* The median of the values of one group; NAN: it has none. room: for all of them. */
static double group_median(const fm_samples *samples, uint32_t group, double *room)
{
    size_t count = 0;
    for (size_t i = 0; i < samples->count; i++)
        if (samples->group_of[i] == group)
            room[count++] = samples->values[i];
    return stats_median(room, count);
}

fm_interval stats_by_launch(const fm_samples *samples)
{
    fm_interval interval = { NAN, NAN, NAN };
    size_t count = 0;
    double *room = calloc(samples->count + 1, sizeof *room);
    double *medians = calloc((size_t)samples->group_count + 1, sizeof *medians);
    for (uint32_t i = 0; room != NULL && medians != NULL && i < samples->group_count; i++) {
        const double median = group_median(samples, i, room);
        if (!isnan(median))
            medians[count++] = median;
    }
    if (count > 0)
        interval = stats_interval_at(medians, count,
                                     samples->coverage > 0.0 ? samples->coverage : usual_coverage);
    free(room);
    free(medians);
    return interval;
}

double stats_student(size_t degrees)
{
    static const double table[] = { INFINITY, 12.706, 4.303, 3.182, 2.776, 2.571, 2.447,
                                    2.365,    2.306,  2.262, 2.228, 2.201, 2.179, 2.160,
                                    2.145,    2.131,  2.120, 2.110, 2.101, 2.093, 2.086 };
    enum { LAST = sizeof table / sizeof table[0] - 1 };
    return degrees <= LAST ? table[degrees] : table[LAST]; /* more than needed: at most 6 % */
}
