/* Gates of one case, drawn from A/A pairs that were measured. */
#ifndef FM_AB_DRAWS_H
#define FM_AB_DRAWS_H

#include "looks.h"

typedef struct ab_draws {
    const double *differences[AB_STATISTIC_COUNT]; /* [count]; borrowed; NULL: not used */
    size_t count;
    size_t *known; /* [known_count]: the pairs that all statistics have; owned */
    size_t known_count;
} ab_draws;

/* FM_NO_MEMORY; draws_close then, too. */
fm_status draws_open(ab_draws *draws, const double *const differences[AB_STATISTIC_COUNT],
                     size_t count, fm_error *err);
void draws_close(ab_draws *draws);

typedef struct ab_gates_desc {
    double shift[AB_STATISTIC_COUNT]; /* added to each difference: logarithms */
    double least[AB_STATISTIC_COUNT]; /* as in looks.h */
    uint32_t gates;
} ab_gates_desc;

/* What gates say: verdicts counts them. All pairs of each are drawn anew, of looks and of the
 * confirmation, either side being NEW by chance, since both are the same build.
 * *state  of base/random.h. FM_NO_MEMORY. */
fm_status draws_gates(uint32_t verdicts[AB_VERDICT_COUNT], const ab_draws *draws,
                      const ab_gates_desc *desc, const ab_policy *policy, uint64_t *state,
                      fm_error *err);

/* The standard error of the median of so many pairs, or of Hodges and Lehmann's estimate, whichever
 * is larger. Of few pairs, some of which are far off, it is larger than closed forms say. The seed
 * is its own: the same pairs give the same answer. FM_NO_MEMORY. */
fm_status draws_error(double *error, const ab_draws *draws, ab_statistic statistic, uint32_t pairs,
                      fm_error *err);

/* The smallest effect on one statistic alone, as a logarithm and to 5 % of itself, that 94 % of
 * gates find, but for those that do not count: log(1 + policy->band) and `least`. The seed is its
 * own. FM_NO_MEMORY. */
fm_status draws_detectable(double *effect, const ab_draws *draws, ab_statistic statistic,
                           double least, const ab_policy *policy, fm_error *err);

#endif
