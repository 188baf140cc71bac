#include "binomial.h"

#include <math.h>

/* Of one try; each is kept, since 1 - chance rounds a small one away. Both are above 0. */
typedef struct odds {
    double hit, miss;
} odds;

/* log(n!) less Stirling's formula without its series, n from 1 on. */
static double stirling_rest(double n)
{
    static const double half_log_of_two_pi = 0.91893853320467274178;
    const double square = n * n;
    if (n <= 15.0)
        return lgamma(n + 1.0) - (n + 0.5) * log(n) + n - half_log_of_two_pi;
    return (1.0 / 12 -
            (1.0 / 360 - (1.0 / 1260 - (1.0 / 1680 - 1.0 / 1188 / square) / square) / square) /
                square) /
           n;
}

/* x log(x / mean) + mean - x: near the mean it is a small difference of large numbers. */
static double deviance(double x, double mean)
{
    const double share = (x - mean) / (x + mean), square = share * share;
    double sum = (x - mean) * share, before = NAN, power = 2.0 * x * share;
    if (fabs(share) >= 0.1)
        return x * log(x / mean) + mean - x;
    for (int odd = 3; sum != before; odd += 2) {
        before = sum;
        power *= square;
        sum += power / odd;
    }
    return sum;
}

/* The chance of exactly k, 1 <= k <= n: Loader's saddle point (2000), which subtracts no large
 * logarithms of factorials. */
static double exactly(uint32_t k, uint32_t n, odds of)
{
    static const double two_pi = 6.28318530717958647693;
    const double tries = n, hits = k, misses = tries - hits;
    if (k == n)
        return exp(tries * (of.hit < 0.5 ? log(of.hit) : log1p(-of.miss)));
    const double logarithm = stirling_rest(tries) - stirling_rest(hits) - stirling_rest(misses) -
                             deviance(hits, tries * of.hit) - deviance(misses, tries * of.miss);
    return exp(logarithm) * sqrt(tries / (two_pi * hits * misses));
}

/* Of k up to n, from the largest term on outwards: terms fall from k on where k is above the mean.
 */
static double upper_tail(uint32_t k, uint32_t n, odds of)
{
    double sum = 0.0, term = exactly(k, n, of);
    const double ratio = of.hit / of.miss;
    for (uint32_t i = k; i <= n && term > sum * 1e-18; i++) {
        sum += term;
        term *= ratio * (double)(n - i) / ((double)i + 1.0);
    }
    return fmin(sum, 1.0);
}

double binomial_at_least(uint32_t k, uint32_t n, double chance)
{
    const odds of = { chance, 1.0 - chance }, turned = { of.miss, of.hit };
    if (k == 0 || chance >= 1.0)
        return k <= n ? 1.0 : 0.0;
    if (k > n || chance <= 0.0)
        return 0.0;
    return (double)k > n * chance ? upper_tail(k, n, of) : 1.0 - upper_tail(n - k + 1, n, turned);
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
