#include "centre.h"

#include <math.h>

#include "base/stats.h"

enum { TRIM = 10 }; /* one of so many, at either end */

fm_centre centre_of(double *ratios, size_t count)
{
    fm_centre centre = { NAN, NAN, count };
    const size_t trimmed = count > 2 ? (count + TRIM - 1) / TRIM : 0;
    const size_t end = count - trimmed, kept = end - trimmed;
    double sum = 0.0, squares = 0.0;
    if (count == 0)
        return centre;
    stats_sort(ratios, count);
    for (size_t i = trimmed; i < end; i++)
        sum += log(ratios[i]);
    centre.ratio = exp(sum / (double)kept);
    if (kept < 2)
        return centre;
    const double ends = log(ratios[trimmed]) + log(ratios[end - 1]);
    const double mean = (sum + (double)trimmed * ends) / (double)count;
    for (size_t i = 0; i < count; i++) {
        const size_t at = i < trimmed ? trimmed : i >= end ? end - 1 : i;
        const double winsorised = log(ratios[at]) - mean;
        squares += winsorised * winsorised;
    }
    const double deviation = sqrt(squares / (double)(count - 1));
    centre.standard_error = deviation * sqrt((double)count) / (double)kept;
    return centre;
}
