#include "walsh.h"

#include <math.h>
#include <stdlib.h>

#include "signed_rank.h"

static void fill_averages(double *averages, const double *differences, size_t count)
{
    size_t used = 0;
    for (size_t i = 0; i < count; i++)
        for (size_t j = i; j < count; j++)
            averages[used++] = 0.5 * differences[i] + 0.5 * differences[j];
}

/* The ends, of sorted averages: as many lie beyond each of them as the rarest sums of ranks allow.
 */
static fm_status find_ends(fm_shift *shift, const double *averages, size_t count, double tail,
                           fm_error *err)
{
    const size_t average_count = count * (count + 1) / 2;
    size_t beyond;
    double chance;
    if (signed_rank_quantile(&beyond, &chance, count, tail)) {
        shift->interval.low = averages[beyond];
        shift->interval.high = averages[average_count - 1 - beyond];
        shift->coverage = 1.0 - 2.0 * chance;
        return FM_OK;
    }
    return isnan(chance) ? fm_fail(err, FM_NO_MEMORY, "no memory for %zu ranks", count) : FM_OK;
}

fm_status walsh_shift(fm_shift *shift, const double *differences, size_t count, double coverage,
                      fm_error *err)
{
    *shift = (fm_shift){ { NAN, NAN, NAN }, NAN };
    const fm_status status = decide_check(differences, count, err);
    if (status != FM_OK)
        return status;
    if (!(coverage > 0.0 && coverage < 1.0))
        return fm_fail(err, FM_INVALID, "coverage %g is not between 0 and 1", coverage);
    const size_t average_count = count * (count + 1) / 2;
    double *averages = calloc(average_count, sizeof *averages);
    if (averages == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu averages", average_count);
    fill_averages(averages, differences, count);
    shift->interval.median = stats_median(averages, average_count);
    const fm_status found = find_ends(shift, averages, count, 0.5 * (1.0 - coverage), err);
    free(averages);
    return found;
}
