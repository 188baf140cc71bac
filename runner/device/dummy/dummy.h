#ifndef FM_DEVICE_DUMMY_H
#define FM_DEVICE_DUMMY_H

#include "device/device.h"

extern const fm_device_ops dummy_device;

#endif
