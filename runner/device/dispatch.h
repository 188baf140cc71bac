/* What all devices check of a dispatch before they execute it. For implementations of devices. */
#ifndef FM_DEVICE_DISPATCH_H
#define FM_DEVICE_DISPATCH_H

#include "device.h"

/* FM_UNSUPPORTED, with both numbers: on some axis the command asks for more workgroups than
 * device->caps.max_groups. Counts that lie in a buffer (fm_dispatch.indirect) are not read. */
fm_status dispatch_check_groups(const fm_device *device, const fm_dispatch *dispatch,
                                fm_error *err);

#endif
