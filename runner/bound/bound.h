/* The least time that a case needs on a device, and what holds a method back there. */
#ifndef FM_BOUND_H
#define FM_BOUND_H

#include "limits.h"

/* What every method is handed and hands over, whatever it does between. */
typedef struct fm_bound_work {
    double fragments; /* that arrive: 8 bytes each are read or produced */
    double kept;      /* of them, those that it is to keep: 8 bytes each, written and read */
    double pixels;    /* of the image: 16 bytes each are written */
    double floor_ms;  /* what delivering the fragments takes: the floor's frame */
} fm_bound_work;

/* Bytes of memory that go with that. */
double bound_bytes(const fm_bound_work *work);
/* The floor, or what copying those bytes takes if that is longer. NAN: the device's copying was not
 * measured, or a number of the work is not known. */
double bound_ms(const fm_bound_work *work, const fm_device_limits *limits);

typedef enum fm_bound_limit {
    FM_BOUND_UNKNOWN, /* something was not measured */
    FM_BOUND_FEED,    /* delivering the fragments takes longest: raster, or a compute feed */
    FM_BOUND_BYTES,   /* bytes_moved, at the rate of copying */
    FM_BOUND_ATOMICS, /* atomics, at the rate at which each invocation has a word of its own */
    FM_BOUND_LIMIT_COUNT
} fm_bound_limit;

/* Column limited_by: "", "feed", "bytes", "atomics". */
const char *bound_limit_name(fm_bound_limit limit);
/* Which of the three takes longest where each runs at the device's rate and all run side by side.
 * It says which of them is nearest to the frame's time, not that it is near. */
fm_bound_limit bound_limited_by(double floor_ms, double bytes_moved, double atomics,
                                const fm_device_limits *limits);

#endif
