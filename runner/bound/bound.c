#include "bound.h"

#include <math.h>

enum { FRAGMENT_BYTES = 8, PIXEL_BYTES = 16 };
static const double ms_per_s = 1e3;

double bound_bytes(const fm_bound_work *work)
{
    return FRAGMENT_BYTES * work->fragments + 2 * FRAGMENT_BYTES * work->kept +
           PIXEL_BYTES * work->pixels;
}

double bound_ms(const fm_bound_work *work, const fm_device_limits *limits)
{
    const double copying_ms = ms_per_s * bound_bytes(work) / limits->values[FM_LIMIT_COPY].median;
    if (isnan(copying_ms) || isnan(work->floor_ms)) /* fmax would leave it out */
        return NAN;
    return fmax(work->floor_ms, copying_ms);
}

static const char *const limit_names[] = {
    [FM_BOUND_UNKNOWN] = "",
    [FM_BOUND_FEED] = "feed",
    [FM_BOUND_BYTES] = "bytes",
    [FM_BOUND_ATOMICS] = "atomics",
};
_Static_assert(sizeof limit_names / sizeof limit_names[0] == FM_BOUND_LIMIT_COUNT, "one each");

const char *bound_limit_name(fm_bound_limit limit)
{
    return limit_names[limit];
}

fm_bound_limit bound_limited_by(double floor_ms, double bytes_moved, double atomics,
                                const fm_device_limits *limits)
{
    const double bytes_ms = ms_per_s * bytes_moved / limits->values[FM_LIMIT_COPY].median;
    const double atomics_ms = ms_per_s * atomics / limits->values[FM_LIMIT_ATOMICS_OWN].median;
    if (isnan(floor_ms) || isnan(bytes_ms) || isnan(atomics_ms))
        return FM_BOUND_UNKNOWN;
    if (floor_ms >= bytes_ms && floor_ms >= atomics_ms)
        return FM_BOUND_FEED;
    return bytes_ms >= atomics_ms ? FM_BOUND_BYTES : FM_BOUND_ATOMICS;
}
