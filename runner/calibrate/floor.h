/* Frames of the floor over flat layers. Of this room alone. */
#ifndef FM_CALIBRATE_FLOOR_H
#define FM_CALIBRATE_FLOOR_H

#include "calibrate.h"

typedef struct floor_frames floor_frames;

/* *made is to be destroyed, NULL included. */
fm_status floor_create(floor_frames **made, const calibrate_desc *desc, fm_error *err);
void floor_destroy(floor_frames *of);
/* Fragments of a frame. */
double floor_fragments(const floor_frames *of);
/* Nanoseconds of one frame, by the device's clock. */
fm_status floor_run(uint64_t *ns, floor_frames *of, fm_error *err);

#endif
