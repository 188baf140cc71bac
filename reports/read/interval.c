#include "interval.h"

#include <math.h>
#include <stdbool.h>

fm_interval interval_difference(fm_interval minuend, fm_interval subtrahend)
{
    if (!interval_is_known(&minuend) || !interval_is_known(&subtrahend))
        return (fm_interval){ minuend.median - subtrahend.median, NAN, NAN };
    const double below = hypot(minuend.median - minuend.low, subtrahend.high - subtrahend.median);
    const double above = hypot(minuend.high - minuend.median, subtrahend.median - subtrahend.low);
    const double median = minuend.median - subtrahend.median;
    return (fm_interval){ median, median - below, median + above };
}

static bool is_exact(fm_interval value)
{
    return value.low == value.high;
}

fm_interval interval_ratio(fm_interval dividend, fm_interval divisor)
{
    const double median = dividend.median / divisor.median;
    if (!interval_is_known(&dividend) || !interval_is_known(&divisor))
        return (fm_interval){ median, NAN, NAN };
    if (is_exact(dividend) && is_exact(divisor))
        return interval_exact(median);
    if (is_exact(divisor) && divisor.median > 0.0)
        return (fm_interval){ median, dividend.low / divisor.median,
                              dividend.high / divisor.median };
    if (dividend.low > 0.0 && divisor.low > 0.0) {
        const double below =
            hypot(log(dividend.median / dividend.low), log(divisor.high / divisor.median));
        const double above =
            hypot(log(dividend.high / dividend.median), log(divisor.median / divisor.low));
        return (fm_interval){ median, median * exp(-below), median * exp(above) };
    }
    if (divisor.low > 0.0) /* a difference about zero: the widest that both allow */
        return (fm_interval){ median, fmin(dividend.low / divisor.low, dividend.low / divisor.high),
                              fmax(dividend.high / divisor.low, dividend.high / divisor.high) };
    return (fm_interval){ median, -INFINITY, INFINITY };
}
