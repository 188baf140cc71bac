/* Device `tbr`: the simulated tile-based GPU as the list of devices knows it.
 *
 * It runs sequences of frames, not passes. A plan finds it by name and learns that it takes the
 * feed `frames` alone; `list devices`, `doctor` and workers list and open it, and read what it is
 * called. That is all: functions that make buffers, images and pipelines, and those that run frames
 * of passes, are NULL. A technique is measured by worker/technique_job.c, which makes a simulator
 * of its own (tbr.h) and draws the sequence with it. */
#ifndef FM_TBR_SEQUENCE_DEVICE_H
#define FM_TBR_SEQUENCE_DEVICE_H

#include "device/device.h"

/* Named "tbr". It takes no selector, needs no driver and no hardware. */
extern const fm_device_ops tbr_sequence_device;

#endif
