/* A device without a GPU, for tests of the runner's logic.
 *
 * Buffers are host memory: write, read, fill and update work. Shaders do not run: draws and
 * dispatches are counted only, pipelines accept any source that does not hold "#error". Time is
 * synthetic and the same in every run: a clock that each command advances by DUMMY_COMMAND_NS and
 * each timed interval by DUMMY_TIMER_NS, which an empty one (a canary) therefore reads. Queries
 * read 0.
 *
 * The selector asks for a fault:
 *   dummy:lost           frame_end answers FM_DEVICE_LOST
 *   dummy:tiny           storage buffers end at DUMMY_TINY_BYTES
 *   dummy:out-of-memory  buffer_create answers FM_NO_MEMORY */
#ifndef FM_DEVICE_DUMMY_H
#define FM_DEVICE_DUMMY_H

#include "device/device.h"

enum { DUMMY_COMMAND_NS = 10, DUMMY_TIMER_NS = 1000, DUMMY_TINY_BYTES = 1024 };

extern const fm_device_ops dummy_device;

/* Commands since the device was opened. */
typedef struct dummy_counts {
    uint64_t frames, draws, dispatches, fills, updates, image_clears;
} dummy_counts;

/* Of a device that dummy_device opened. */
dummy_counts dummy_counts_of(const fm_device *device);

#endif
