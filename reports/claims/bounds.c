#include "bounds.h"

#include <math.h>

/* A bound of 0 is widened by the tolerance itself. */
static double slack(const fm_claim *claim, double bound)
{
    return bound == 0.0 ? claim->tolerance : claim->tolerance * fabs(bound);
}

void bounds_of(double bounds[2], const fm_claim *claim)
{
    bounds[0] = isinf(claim->low) ? claim->low : claim->low - slack(claim, claim->low);
    bounds[1] = isinf(claim->high) ? claim->high : claim->high + slack(claim, claim->high);
}

fm_verdict_kind bounds_judge(const fm_claim *claim, fm_interval value)
{
    double bounds[2];
    bounds_of(bounds, claim);
    if (value.low >= bounds[0] && value.high <= bounds[1])
        return FM_VERDICT_HOLDS;
    return value.high < bounds[0] || value.low > bounds[1] ? FM_VERDICT_FAILS : FM_VERDICT_UNCLEAR;
}

double bounds_margin(const fm_claim *claim, double value)
{
    double margin = INFINITY;
    if (!isinf(claim->low))
        margin = (value - claim->low) / fmax(fabs(claim->low), 1e-9);
    if (!isinf(claim->high))
        margin = fmin(margin, (claim->high - value) / fmax(fabs(claim->high), 1e-9));
    return margin;
}
