/* What a device can do at most, measured: the numbers of bound/limits.h.
 *
 * The room calibrate runs shaders of its own on an open device, timed by the device's clock. It
 * keeps nothing and judges nothing. */
#ifndef FM_CALIBRATE_H
#define FM_CALIBRATE_H

#include "bound/limits.h"
#include "code/shader_files.h"
#include "device/device.h"

typedef struct calibrate_desc {
    fm_device *device;
    const fm_method_desc *floor; /* of feed raster */
    fm_shader_folders folders;   /* the floor's, and the runner's */
} calibrate_desc;

/* Fills the values, and of the key device_name and driver. Each value is the median of up to 11
 * repeats with their interval (base/stats.h), all of one process; NAN where the device cannot do
 * it, or has no clock. Takes a second for each value at most, and more only where one repeat does.
 * Statuses as fm_device_ops and instance_create. */
fm_status calibrate_device(fm_device_limits *limits, const calibrate_desc *desc, fm_error *err);

#endif
