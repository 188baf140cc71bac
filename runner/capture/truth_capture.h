/* Fragments that a device delivers, brought to the host: how a truth is made.
 *
 * This room runs the runner's own capturing passes; how a method's fragments are checked is the
 * worker's. */
#ifndef FM_TRUTH_CAPTURE_H
#define FM_TRUTH_CAPTURE_H

#include "code/shader_files.h"
#include "device/device.h"
#include "truth/truth.h"

/* Captures the scene (count, prefix sum, store in bands of pixels), sorts it and writes it to path,
 * atomically. A band is what is held in memory. feed: one of FM_FEED_*. FM_FEED_TRIANGLES: as
 * rasterise.h says, whatever the device; the scene is held. Else as the device's rasteriser
 * delivers it; of flat layers without ties it counts all and stores the first band, and while these
 * agree with the closed form, that fills the bands that follow. folders: of the runner's GLSL. */
fm_status truth_capture(const char *path, fm_device *device, const fm_scene *scene, uint32_t feed,
                        const fm_shader_folders *folders, fm_error *err);

#endif
