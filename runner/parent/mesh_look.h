/* What the meshes of a plan hold, without a run: each is read once by a worker, which may crash. */
#ifndef FM_MESH_LOOK_H
#define FM_MESH_LOOK_H

#include <stdio.h>

#include "base/error.h"
#include "base/text_index.h"
#include "plan/plan.h"

/* Writes a line for each mesh file of the plan: what was loaded, or why it is refused. Adds the
 * files that were refused to *unread. worker: executable; NULL: this program. Ends early when a
 * signal asks to stop. FM_IO, FM_INVALID: no worker could be started. FM_NO_MEMORY. */
fm_status mesh_look(fm_text_index *unread, FILE *talk, const fm_plan *plan, const char *worker,
                    fm_error *err);

#endif
