/* What a plan is to know that only a worker finds out, because it may crash of it: what meshes
 * hold, and what a device is. Without a run. */
#ifndef FM_PLAN_LOOK_H
#define FM_PLAN_LOOK_H

#include <stdio.h>

#include "base/error.h"
#include "base/text_index.h"
#include "plan/plan.h"

/* Starts as {0}; whoever looks frees `unread`, whatever the status. */
typedef struct fm_mesh_look {
    fm_text_index unread; /* files that were refused */
    int stop_signal;      /* asked to stop, and not all were looked at; 0: none */
} fm_mesh_look;

/* Writes a line for each mesh file of the plan: what was loaded, or why it is refused. worker:
 * executable; NULL: this program. FM_IO, FM_INVALID: no worker could be started. FM_NO_MEMORY. */
fm_status mesh_look(fm_mesh_look *found, FILE *talk, const fm_plan *plan, const char *worker,
                    fm_error *err);

/* As fm_plan_request.ask: has a worker open the device. `worker`: the executable, a const char *;
 * NULL: this program. FM_IO: it cannot be opened, with the reason, or no worker could be started.
 */
fm_status device_look(fm_auto_device *found, const void *worker, const char *device, fm_error *err);

#endif
