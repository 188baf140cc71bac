#include "binomial.h"

#include <math.h>

/* The logarithm of the chance of exactly k; 0 < chance < 1. */
static double log_exactly(uint32_t k, uint32_t n, double chance)
{
    const double tries = n, hits = k;
    return lgamma(tries + 1.0) - lgamma(hits + 1.0) - lgamma(tries - hits + 1.0) +
           hits * log(chance) + (tries - hits) * log1p(-chance);
}

/* Of k up to n, from the largest term on outwards: terms fall from k on where k is above the mean.
 */
static double upper_tail(uint32_t k, uint32_t n, double chance)
{
    double sum = 0.0, term = exp(log_exactly(k, n, chance));
    const double odds = chance / (1.0 - chance);
    for (uint32_t i = k; i <= n && term > sum * 1e-18; i++) {
        sum += term;
        term *= odds * (double)(n - i) / ((double)i + 1.0);
    }
    return fmin(sum, 1.0);
}

double binomial_at_least(uint32_t k, uint32_t n, double chance)
{
    if (k == 0 || chance >= 1.0)
        return k <= n ? 1.0 : 0.0;
    if (k > n || chance <= 0.0)
        return 0.0;
    return (double)k > n * chance ? upper_tail(k, n, chance)
                                  : 1.0 - upper_tail(n - k + 1, n, 1.0 - chance);
}

/* The chance under which k or more are as likely as `tail`: it rises with the chance. */
static double solve(uint32_t k, uint32_t n, double tail)
{
    double low = 0.0, high = 1.0;
    for (;;) {
        const double middle = 0.5 * (low + high);
        if (middle <= low || middle >= high)
            return middle;
        if (binomial_at_least(k, n, middle) < tail)
            low = middle;
        else
            high = middle;
    }
}

fm_status binomial_interval(fm_interval *interval, uint32_t k, uint32_t n, double coverage,
                            fm_error *err)
{
    const double tail = 0.5 * (1.0 - coverage);
    *interval = (fm_interval){ NAN, NAN, NAN };
    if (n == 0 || n > BINOMIAL_TRIES || k > n)
        return fm_fail(err, FM_INVALID, "%u of %u: 0 to n of 1 to %d tries have an interval", k, n,
                       BINOMIAL_TRIES);
    if (!(coverage > 0.0 && coverage < 1.0))
        return fm_fail(err, FM_INVALID, "coverage %g is not between 0 and 1", coverage);
    interval->median = (double)k / n;
    interval->low = k == 0 ? 0.0 : solve(k, n, tail);
    interval->high = k == n ? 1.0 : 1.0 - solve(n - k, n, tail); /* failures: few, not many */
    return FM_OK;
}
