#ifndef FM_DEVICE_VULKAN_H
#define FM_DEVICE_VULKAN_H

#include "device/device.h"

extern const fm_device_ops vulkan_device;

#endif
