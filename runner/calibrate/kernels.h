/* The shaders of a calibration, each with what it works on. Of this room alone. */
#ifndef FM_CALIBRATE_KERNELS_H
#define FM_CALIBRATE_KERNELS_H

#include "calibrate.h"

/* Compute passes in one timed interval: each of `passes` depends on the one before. */
typedef struct kernel {
    fm_device *device;
    fm_pipeline *pipeline; /* NULL: the interval is empty */
    fm_buffer *buffers[2]; /* bound as 0 and 1, and the other way round in every second pass; the
                              second may be NULL */
    uint32_t groups[3];    /* of a pass */
    uint32_t passes;
    double units; /* what one interval does: bytes, atomics, passes */
} kernel;

/* Copies one large buffer to the other and back. units: bytes read and written. */
fm_status kernel_copy(kernel *made, fm_device *device, fm_error *err);
/* Adds to words of 4 or 8 bytes; `lanes` neighbouring invocations share one, all where it is 0.
 * scale: 0 is the smallest number of invocations; each further one four times as many.
 * FM_UNSUPPORTED: no such atomics. units: atomics. */
fm_status kernel_atomics(kernel *made, fm_device *device, uint32_t word_bytes, uint32_t lanes,
                         uint32_t scale, fm_error *err);
/* One workgroup that does nothing, many times. units: passes. */
fm_status kernel_dispatch(kernel *made, fm_device *device, fm_error *err);
/* An interval without a pass. units: 1. */
void kernel_timer(kernel *made, fm_device *device);
/* Accepts what a failure left, and zeros. */
void kernel_free(kernel *made);

/* Nanoseconds of one interval, by the device's clock. */
fm_status kernel_run(uint64_t *ns, const kernel *of, fm_error *err);

#endif
