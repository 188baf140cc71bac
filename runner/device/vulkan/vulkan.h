/* Device `vulkan`: lavapipe or a GPU, through the Vulkan loader.
 *
 * It needs Vulkan 1.3 with hostQueryReset and fragmentStoresAndAtomics, and one queue for graphics
 * and compute; drivers without are not listed. The selector is an index, as `list devices` shows
 * it (discrete GPUs first, the CPU last), or a part of a driver's name. Nothing but device.h is
 * offered: what the folder's files share is in context.h. */
#ifndef FM_DEVICE_VULKAN_H
#define FM_DEVICE_VULKAN_H

#include "device/device.h"

/* Named "vulkan". */
extern const fm_device_ops vulkan_device;

#endif
