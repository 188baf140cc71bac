/* What all devices check of a dispatch before they execute it. For implementations of devices:
 * callers of fm_device_ops.dispatch get the same status from there. */
#ifndef FM_DEVICE_DISPATCH_H
#define FM_DEVICE_DISPATCH_H

#include "device.h"

/* FM_OK: the device can start so many workgroups, or their counts lie in a buffer
 * (fm_dispatch.indirect), which is not read.
 * FM_UNSUPPORTED, with both numbers: on some axis there are more than device->caps.max_groups. The
 * caller of the device must not have executed anything of the command by then. */
fm_status dispatch_check_groups(const fm_device *device, const fm_dispatch *dispatch,
                                fm_error *err);

#endif
