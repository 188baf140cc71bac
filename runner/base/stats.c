#include "stats.h"

#include <math.h>
#include <stdlib.h>

static const double wanted_coverage = 0.95;

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
 * share of itself, to hold its median 95 times of 100. That of 5 holds it 93.75 times, whatever the
 * distribution, and stays. */
static const double widening[] = { [2] = 5.85, [3] = 0.815, [4] = 0.239, [5] = 0.0 };
enum { WIDENED_MOST = sizeof widening / sizeof widening[0] - 1 };

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

/* Of six and more sorted values: between ranks. */
static void interpolate_ends(double *low, double *high, const double *sorted, size_t count)
{
    size_t rank = 1;
    while (coverage_of_rank(count, rank + 1) >= wanted_coverage)
        rank++;
    const double n = (double)count, r = (double)rank;
    const double outer = coverage_of_rank(count, rank), inner = coverage_of_rank(count, rank + 1);
    const double share = (outer - wanted_coverage) / (outer - inner);
    const double weight = (n - r) * share / (r + (n - 2.0 * r) * share);
    *low = (1.0 - weight) * sorted[rank - 1] + weight * sorted[rank];
    *high = (1.0 - weight) * sorted[count - rank] + weight * sorted[count - rank - 1];
}

/* Of two to five sorted values: beyond the least and the greatest. */
static void widen_ends(double *low, double *high, const double *sorted, size_t count)
{
    const double least = sorted[0], greatest = sorted[count - 1];
    if (least > 0.0) {
        const double factor = pow(greatest / least, widening[count]);
        *low = least / factor;
        *high = greatest * factor;
        return;
    }
    *low = least - widening[count] * (greatest - least);
    *high = greatest + widening[count] * (greatest - least);
}

fm_interval stats_interval(double *values, size_t count)
{
    fm_interval interval = { stats_median(values, count), NAN, NAN }; /* now they are sorted */
    if (count < 2 || isnan(interval.median))
        return interval;
    if (count <= WIDENED_MOST)
        widen_ends(&interval.low, &interval.high, values, count);
    else
        interpolate_ends(&interval.low, &interval.high, values, count);
    return interval;
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
        interval = stats_interval(medians, count);
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
