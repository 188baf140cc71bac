#include "decide.h"

#include <math.h>

fm_status decide_check(const double *values, size_t count, fm_error *err)
{
    if (count == 0 || count > DECIDE_VALUES)
        return fm_fail(err, FM_INVALID, "%zu values; 1 to %d can be decided on", count,
                       DECIDE_VALUES);
    for (size_t i = 0; i < count; i++)
        if (!isfinite(values[i]))
            return fm_fail(err, FM_INVALID, "value %zu is %g: no finite number", i, values[i]);
    return FM_OK;
}
