/* Device `osmesa`: OpenGL 4.5 without a window, by Mesa's llvmpipe through libOSMesa.
 *
 * There is one such device, and a selector is refused. It has no buffer addresses and no 64-bit
 * atomics, bound buffers end at 128 MiB, and its images have 1 or 4 samples. Commands run when they
 * are issued, each after all that came before. Nothing but device.h is offered: what the folder's
 * files share is in context.h. */
#ifndef FM_DEVICE_OSMESA_H
#define FM_DEVICE_OSMESA_H

#include "device/device.h"

/* Named "osmesa"; in builds with FM_OSMESA alone. */
extern const fm_device_ops osmesa_device;

#endif
