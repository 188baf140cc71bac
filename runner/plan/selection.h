/* What a request asks for, command line and spec file put together, before anything is looked up.
 */
#ifndef FM_SELECTION_H
#define FM_SELECTION_H

#include "base/error.h"
#include "base/text.h"
#include "model/sweep.h"
#include "plan.h"

typedef enum fm_listed {
    FM_LISTED_METHODS,
    FM_LISTED_SCENES,
    FM_LISTED_DEVICES,
    FM_LISTED_FEEDS,
    FM_LISTED_COUNT,
} fm_listed;

enum { FM_MAX_SWEEPS = 64 };

typedef struct fm_selection {
    fm_text_list names[FM_LISTED_COUNT];
    fm_text_list origins[FM_LISTED_COUNT]; /* where each name stands: "spec.yml:3", "--method" */
    fm_sweep *sweeps;
    size_t sweep_count;
} fm_selection;

/* FM_INVALID: an axis without '=', given twice, or with an illegal value; n and r together; a spec
 * that is not a mapping of such; FM_IO, FM_NO_MEMORY. */
fm_status selection_read(fm_selection *selection, const fm_plan_request *request, fm_error *err);
void selection_free(fm_selection *selection);

/* The axis of that name, or NULL. */
const fm_sweep *selection_find(const fm_selection *selection, const char *name);
/* The word nearest in spelling among keys and lists. */
const char *selection_nearest(const char *name);

#endif
