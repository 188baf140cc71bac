#include "interval.h"

#include <math.h>
#include <stdbool.h>

fm_interval interval_difference(fm_interval of, fm_interval minus)
{
    const double below = hypot(of.median - of.low, minus.high - minus.median);
    const double above = hypot(of.high - of.median, minus.median - minus.low);
    const double median = of.median - minus.median;
    return (fm_interval){ median, median - below, median + above };
}

static bool is_exact(fm_interval value)
{
    return value.low == value.high;
}

fm_interval interval_ratio(fm_interval of, fm_interval over)
{
    const double median = of.median / over.median;
    if (is_exact(of) && is_exact(over))
        return (fm_interval){ median, median, median };
    if (is_exact(over) && over.median > 0.0)
        return (fm_interval){ median, of.low / over.median, of.high / over.median };
    if (of.low > 0.0 && over.low > 0.0) {
        const double below = hypot(log(of.median / of.low), log(over.high / over.median));
        const double above = hypot(log(of.high / of.median), log(over.median / over.low));
        return (fm_interval){ median, median * exp(-below), median * exp(above) };
    }
    if (over.low > 0.0) /* a difference about zero: the widest that both allow */
        return (fm_interval){ median, fmin(of.low / over.low, of.low / over.high),
                              fmax(of.high / over.low, of.high / over.high) };
    return (fm_interval){ median, -INFINITY, INFINITY };
}
