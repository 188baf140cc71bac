#include "rank_sum.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include "base/stats.h"
#include "ranks.h"

/* How many ways there are to choose so many of the values with so large a sum of ranks. */
typedef struct choices {
    uint32_t *ranks; /* [count]: doubled, of each value */
    size_t count;
    size_t most;    /* so many are chosen at most */
    size_t sums;    /* sums are below this */
    double *ways;   /* [most + 1][sums] */
    double *sorted; /* [count] */
} choices;

static void choices_free(choices *all)
{
    free(all->sorted);
    free(all->ways);
    free(all->ranks);
}

/* One value after the other: it is chosen, or it is not. */
static void add_values(choices *all)
{
    size_t greatest = 0; /* sum so far */
    all->ways[0] = 1.0;
    for (size_t i = 0; i < all->count; i++) {
        const size_t rank = all->ranks[i];
        greatest = greatest + rank < all->sums ? greatest + rank : all->sums - 1;
        for (size_t chosen = i + 1 < all->most ? i + 1 : all->most; chosen > 0; chosen--) {
            double *to = all->ways + chosen * all->sums;
            const double *from = to - all->sums;
            for (size_t sum = rank; sum <= greatest; sum++)
                to[sum] += from[sum - rank];
        }
    }
}

static fm_status choices_make(choices *all, const double *values, size_t count, size_t most,
                              fm_error *err)
{
    *all = (choices){ .count = count, .most = most, .sums = 2 * count * most + 1 };
    all->ranks = calloc(count, sizeof *all->ranks);
    all->sorted = calloc(count, sizeof *all->sorted);
    all->ways = calloc((most + 1) * all->sums, sizeof *all->ways);
    if (all->ranks == NULL || all->sorted == NULL || all->ways == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the ranks of %zu values", count);
    memcpy(all->sorted, values, count * sizeof *values);
    stats_sort(all->sorted, count);
    for (size_t i = 0; i < count; i++)
        all->ranks[i] = doubled_rank(all->sorted, count, values[i]);
    add_values(all);
    return FM_OK;
}

/* The shares of choices of `chosen` values with a sum up to, and from, this one. */
static void find_tails(double *up_to, double *from, const choices *all, size_t chosen, size_t sum)
{
    const double *ways = all->ways + chosen * all->sums;
    double below = 0.0, above = 0.0;
    for (size_t s = 0; s < sum; s++)
        below += ways[s];
    for (size_t s = all->sums; s-- > sum + 1;)
        above += ways[s];
    const double total = below + ways[sum] + above;
    *up_to = (below + ways[sum]) / total;
    *from = (ways[sum] + above) / total;
}

static size_t sum_of(const choices *all, size_t first, size_t end)
{
    size_t sum = 0;
    for (size_t i = first; i < end; i++)
        sum += all->ranks[i];
    return sum;
}

/* Of values parted there. The smaller sample is the one that is chosen. */
static void test_split(fm_rank_sum *test, const choices *all, size_t first_count)
{
    const size_t second_count = all->count - first_count;
    if (second_count <= first_count)
        find_tails(&test->p_less, &test->p_greater, all, second_count,
                   sum_of(all, first_count, all->count));
    else
        find_tails(&test->p_greater, &test->p_less, all, first_count, sum_of(all, 0, first_count));
    test->p_two_sided = fmin(1.0, 2.0 * fmin(test->p_less, test->p_greater));
}

static fm_status check(const double *values, size_t first_count, size_t count, fm_error *err)
{
    if (count > RANK_SUM_VALUES || first_count == 0 || first_count >= count)
        return fm_fail(err, FM_INVALID,
                       "%zu of %zu values are the first sample: both have some, of %d together",
                       first_count, count, RANK_SUM_VALUES);
    return decide_check(values, count, err);
}

static fm_status find_shift(double *shift, const double *values, size_t first_count, size_t count,
                            fm_error *err)
{
    const size_t second_count = count - first_count;
    double *differences = calloc(first_count * second_count, sizeof *differences);
    if (differences == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the differences of %zu values", count);
    for (size_t i = 0; i < first_count; i++)
        for (size_t j = 0; j < second_count; j++)
            differences[i * second_count + j] = values[first_count + j] - values[i];
    *shift = stats_median(differences, first_count * second_count);
    free(differences);
    return FM_OK;
}

fm_status rank_sum_test(fm_rank_sum *test, const double *values, size_t first_count, size_t count,
                        fm_error *err)
{
    choices all;
    *test = (fm_rank_sum){ NAN, NAN, NAN, NAN };
    fm_status status = check(values, first_count, count, err);
    if (status != FM_OK)
        return status;
    const size_t smaller = 2 * first_count < count ? first_count : count - first_count;
    status = choices_make(&all, values, count, smaller, err);
    if (status == FM_OK) {
        test_split(test, &all, first_count);
        status = find_shift(&test->shift, values, first_count, count, err);
    }
    choices_free(&all);
    return status;
}

fm_status rank_sum_splits(double *p, const double *values, size_t count, fm_error *err)
{
    choices all;
    fm_status status = check(values, 1, count, err);
    if (status != FM_OK)
        return status;
    status = choices_make(&all, values, count, count / 2, err);
    for (size_t i = 1; i < count && status == FM_OK; i++) {
        fm_rank_sum test;
        test_split(&test, &all, i);
        p[i] = test.p_two_sided;
    }
    p[0] = 1.0;
    choices_free(&all);
    return status;
}
