#include "pool.h"

#include <math.h>
#include <string.h>

enum { DIGIT_BITS = 8, DIGITS = 1 << DIGIT_BITS, WORD_BITS = 32 };

/* One pass of a radix sort: by the digit at `shift`. */
static void sort_digit(float *to, const float *from, size_t count, int shift)
{
    size_t begin[DIGITS] = { 0 };
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &from[i], sizeof bits);
        begin[bits >> shift & (DIGITS - 1)]++;
    }
    size_t sum = 0;
    for (int digit = 0; digit < DIGITS; digit++) {
        const size_t here = begin[digit];
        begin[digit] = sum;
        sum += here;
    }
    for (size_t i = 0; i < count; i++) {
        uint32_t bits;
        memcpy(&bits, &from[i], sizeof bits);
        to[begin[bits >> shift & (DIGITS - 1)]++] = from[i];
    }
}

/* Floats from 0 up stand in the order of their bits. */
void pool_sort(float *values, float *spare, size_t count)
{
    for (int shift = 0; shift < WORD_BITS; shift += 2 * DIGIT_BITS) {
        sort_digit(spare, values, count, shift);
        sort_digit(values, spare, count, shift + DIGIT_BITS);
    }
}

/* p in (0, 1]: the least value that so many are not above. */
static double percentile(const float *sorted, size_t count, double p)
{
    const double rank = ceil(p * (double)count);
    return (double)sorted[rank < 1 ? 0 : (size_t)rank - 1];
}

static double weighted_median(const float *sorted, size_t count, double sum)
{
    double below = 0;
    if (!isfinite(sum) || sum == 0)
        return sum;
    for (size_t i = 0; i < count; i++) {
        below += (double)sorted[i];
        if (below >= sum / 2)
            return (double)sorted[i];
    }
    return (double)sorted[count - 1];
}

void pool_values(fm_pooled *pooled, float *values, float *spare, size_t count)
{
    *pooled = (fm_pooled){ NAN, NAN, NAN, NAN, NAN };
    if (count == 0)
        return;
    double sum = 0;
    for (size_t i = 0; i < count; i++)
        sum += (double)values[i];
    pool_sort(values, spare, count);
    *pooled = (fm_pooled){ .mean = sum / (double)count,
                           .weighted_median = weighted_median(values, count, sum),
                           .p95 = percentile(values, count, 0.95),
                           .p99 = percentile(values, count, 0.99),
                           .max = (double)values[count - 1] };
}
