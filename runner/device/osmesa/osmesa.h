#ifndef FM_DEVICE_OSMESA_H
#define FM_DEVICE_OSMESA_H

#include "device/device.h"

extern const fm_device_ops osmesa_device;

#endif
