/* Device `tbr`: the simulated tile-based GPU (tbr.h). It runs frames, not passes. */
#ifndef FM_TBR_DEVICE_H
#define FM_TBR_DEVICE_H

#include "device/device.h"

extern const fm_device_ops tbr_device;

#endif
