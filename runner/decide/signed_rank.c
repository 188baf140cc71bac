#include "signed_rank.h"

#include <math.h>
#include <stdint.h>
#include <stdlib.h>

#include "base/stats.h"
#include "ranks.h"

/* chances[s], all 0 before, up to the sum of all ranks: that the ranks whose coin shows heads add
 * up to s. */
static void add_coins(double *chances, const uint32_t *ranks, size_t count)
{
    size_t most = 0;
    chances[0] = 1.0;
    for (size_t i = 0; i < count; i++) {
        most += ranks[i];
        for (size_t s = most; s >= ranks[i]; s--)
            chances[s] = 0.5 * (chances[s] + chances[s - ranks[i]]);
        for (size_t s = 0; s < ranks[i]; s++)
            chances[s] *= 0.5;
    }
}

/* From the small end, so that rare sums keep their digits. */
static double chance_up_to(const double *chances, size_t last)
{
    double chance = 0.0;
    for (size_t s = 0; s <= last; s++)
        chance += chances[s];
    return fmin(chance, 1.0);
}

/* The ranks of those that are not 0, and how the sum of all and that of the positive ones are. */
static void rank(fm_signed_rank *test, uint32_t *ranks, size_t *all, double *sorted,
                 const double *differences, size_t count)
{
    for (size_t i = 0; i < count; i++)
        sorted[i] = fabs(differences[i]);
    stats_sort(sorted, count);
    *all = 0;
    for (size_t i = 0; i < count; i++) {
        if (differences[i] == 0.0)
            continue;
        const uint32_t doubled = doubled_rank(sorted, count, fabs(differences[i]));
        ranks[test->count++] = doubled;
        *all += doubled;
        test->sum += differences[i] > 0.0 ? 0.5 * doubled : 0.0;
    }
}

fm_status signed_rank_test(fm_signed_rank *test, const double *differences, size_t count,
                           fm_error *err)
{
    size_t all;
    *test = (fm_signed_rank){ 0 };
    fm_status status = decide_check(differences, count, err);
    if (status != FM_OK)
        return status;
    uint32_t *ranks = calloc(count, sizeof *ranks);
    double *sorted = calloc(count, sizeof *sorted);
    double *chances = calloc(count * (count + 1) + 1, sizeof *chances); /* ranks are doubled */
    if (ranks == NULL || sorted == NULL || chances == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for the ranks of %zu values", count);
        goto out;
    }
    rank(test, ranks, &all, sorted, differences, count);
    add_coins(chances, ranks, test->count);
    const size_t sum = (size_t)lround(2.0 * test->sum);
    test->p_less = chance_up_to(chances, sum);
    test->p_greater = chance_up_to(chances, all - sum); /* heads and tails change places */
    test->p_two_sided = fmin(1.0, 2.0 * fmin(test->p_less, test->p_greater));
out:
    free(chances);
    free(sorted);
    free(ranks);
    return status;
}

bool signed_rank_quantile(size_t *c, double *chance, size_t count, double tail)
{
    uint32_t *ranks = calloc(count + 1, sizeof *ranks);
    double *chances = calloc(count * (count + 1) / 2 + 1, sizeof *chances);
    bool is_found = false;
    *chance = NAN;
    for (size_t i = 0; ranks != NULL && i < count; i++)
        ranks[i] = (uint32_t)(i + 1);
    if (ranks != NULL && chances != NULL) {
        double sum = 0.0;
        size_t next = 0;
        add_coins(chances, ranks, count);
        while (sum + chances[next] <= tail)
            sum += chances[next++];
        is_found = next > 0;
        *c = next - 1;
        *chance = sum;
    }
    free(chances);
    free(ranks);
    return is_found;
}
