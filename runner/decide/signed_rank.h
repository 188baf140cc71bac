/* Wilcoxon's signed-rank test, exact (Wilcoxon 1945, doi:10.2307/3001968). */
#ifndef FM_DECIDE_SIGNED_RANK_H
#define FM_DECIDE_SIGNED_RANK_H

#include <stdbool.h>

#include "decide.h"

/* How likely sums of ranks as far off as this one are, if each difference has either sign with the
 * same chance. */
typedef struct fm_signed_rank {
    size_t count;     /* of differences that are not 0 */
    double sum;       /* of the ranks of the positive ones */
    double p_greater; /* of a sum as large or larger: small if differences are above 0 */
    double p_less;    /* of a sum as small or smaller */
    double p_two_sided;
} fm_signed_rank;

/* Ranks are of the absolute differences; equal ones share the mean of their ranks. Zeros take part
 * in the ranking, and then have no sign and no part in the sum (Pratt 1959,
 * doi:10.1080/01621459.1959.10501526). Dropping them first, as Wilcoxon did, can make a test
 * significant by moving all differences away from what it claims. Without zeros both are the same.
 *
 * The p-values are exact, with ties and zeros too: the signs are the only chance, and the
 * distribution over all 2^count of them is added up rank by rank. All zero: p is 1. The relative
 * error is below 1e-12. 40 differences take 14 us, 1000 take 0.2 s.
 *
 * FM_INVALID as decide_check; FM_NO_MEMORY. */
fm_status signed_rank_test(fm_signed_rank *test, const double *differences, size_t count,
                           fm_error *err);

/* The greatest c for which a sum of ranks of c or less has a chance of at most `tail`, of `count`
 * differences without ties and zeros; *chance is that of c or less. false: not even a sum of 0 is
 * that rare; or no memory, which *chance = NAN tells. */
bool signed_rank_quantile(size_t *c, double *chance, size_t count, double tail);

#endif
