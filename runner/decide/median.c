#include "median.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "binomial.h"

/* One value that the median of draws can have, and how likely. */
typedef struct outcome {
    double value, chance;
} outcome;

typedef struct outcomes {
    outcome *items; /* owned */
    size_t count;
} outcomes;

static void add(outcomes *all, double value, double chance)
{
    if (chance > 0.0)
        all->items[all->count++] = (outcome){ value, chance };
}

/* That at least `rank` of n draws are of the first i of n values. */
static double at_least(size_t rank, size_t i, size_t n)
{
    return binomial_at_least((uint32_t)rank, (uint32_t)n, (double)i / (double)n);
}

/* Odd: the middle draw is value i if at least half of all are of the first i, and not of those
 * before. */
static void add_middle(outcomes *all, const double *sorted, size_t n)
{
    double before = 0.0;
    for (size_t i = 1; i <= n; i++) {
        const double until = at_least(n / 2 + 1, i, n);
        add(all, sorted[i - 1], until - before);
        before = until;
    }
}

/* Of i = 0 to n: sqrt(C(n, n / 2)) * (i / n)^(n / 2), that half of the draws are of i of the n
 * values; two such factors are a chance, and neither overflows. */
static void fill_half_draws(double *factors, size_t n)
{
    const size_t draws = n / 2;
    const double half = (double)draws;
    const double ways = 0.5 * (lgamma((double)n + 1.0) - 2.0 * lgamma(half + 1.0));
    factors[0] = 0.0;
    for (size_t i = 1; i <= n; i++)
        factors[i] = exp(ways + half * log((double)i / (double)n));
}

/* Even: the lower half of the draws has its greatest at value i, the upper half its least at value
 * j. What is left of the chance that the lower one is i has both there. */
static void add_middle_two(outcomes *all, const double *sorted, const double *factors, size_t n)
{
    for (size_t i = 1; i <= n; i++) {
        const double lower = factors[i] - factors[i - 1];
        for (size_t j = i + 1; j <= n; j++)
            add(all, 0.5 * sorted[i - 1] + 0.5 * sorted[j - 1],
                lower * (factors[n - j + 1] - factors[n - j]));
        add(all, sorted[i - 1],
            at_least(n / 2, i, n) - at_least(n / 2, i - 1, n) - lower * factors[n - i]);
    }
}

static int compare_outcomes(const void *left, const void *right)
{
    const double a = ((const outcome *)left)->value, b = ((const outcome *)right)->value;
    return (a > b) - (a < b);
}

/* Rising outcomes, whose chances add up to 1. */
static double deviation(const outcomes *all)
{
    double mean = 0.0, square = 0.0;
    for (size_t i = 0; i < all->count; i++)
        mean += all->items[i].chance * all->items[i].value;
    for (size_t i = 0; i < all->count; i++) {
        const double off = all->items[i].value - mean;
        square += all->items[i].chance * off * off;
    }
    return sqrt(square);
}

static void find_ends(fm_interval *interval, const outcomes *all, double tail)
{
    double sum = 0.0;
    size_t low = 0, high = all->count - 1;
    while (low < high && (sum += all->items[low].chance) < tail)
        low++;
    sum = 0.0;
    while (high > low && (sum += all->items[high].chance) < tail)
        high--;
    interval->low = all->items[low].value;
    interval->high = all->items[high].value;
}

fm_status median_bootstrap(fm_median *median, const double *values, size_t count, double coverage,
                           fm_error *err)
{
    *median = (fm_median){ { NAN, NAN, NAN }, NAN };
    fm_status status = decide_check(values, count, err);
    if (status != FM_OK)
        return status;
    if (!(coverage > 0.0 && coverage < 1.0))
        return fm_fail(err, FM_INVALID, "coverage %g is not between 0 and 1", coverage);
    double *sorted = calloc(count, sizeof *sorted);
    double *factors = calloc(count + 1, sizeof *factors);
    outcomes all = { calloc(count * (count + 1) / 2, sizeof *all.items), 0 };
    if (sorted == NULL || factors == NULL || all.items == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for the medians of %zu values", count);
        goto out;
    }
    memcpy(sorted, values, count * sizeof *sorted);
    median->interval.median = stats_median(sorted, count);
    if (count % 2 == 1)
        add_middle(&all, sorted, count);
    else {
        fill_half_draws(factors, count);
        add_middle_two(&all, sorted, factors, count);
    }
    qsort(all.items, all.count, sizeof *all.items, compare_outcomes);
    median->standard_error = deviation(&all);
    find_ends(&median->interval, &all, 0.5 * (1.0 - coverage));
out:
    free(all.items);
    free(factors);
    free(sorted);
    return status;
}
