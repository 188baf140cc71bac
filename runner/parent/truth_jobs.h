/* Which truths a run needs, and which of them each case is compared with. */
#ifndef FM_TRUTH_JOBS_H
#define FM_TRUTH_JOBS_H

#include <stdbool.h>

#include "plan/plan.h"
#include "plugin/plugin.h"

#define FM_NO_CASE SIZE_MAX

/* One truth: a scene as a device's rasteriser sees it. raster and compute feeds share it, and the
 * floor that their cases are measured beside. */
typedef struct fm_truth_job {
    char name[200];    /* of its files: SCENEHASH-DEVICE[-FEED] */
    size_t of, last;   /* the first and the last case that need it */
    const char *floor; /* path of the floor's plugin; "": all its cases are skipped, or frames,
                          which have none */
    bool is_captured;  /* by this process, or found: whoever chooses launches asks but once */
} fm_truth_job;

typedef struct fm_truth_jobs {
    fm_truth_job *jobs;
    size_t count;
    size_t *of_case;      /* [plan->count]: which job */
    size_t *next_of_same; /* [plan->count]: the next case of the same job; FM_NO_CASE: none */
} fm_truth_jobs;

/* FM_INVALID: no plugin is the floor of a feed. */
fm_status truth_jobs_create(fm_truth_jobs *jobs, const fm_plan *plan, const fm_plugin_list *plugins,
                            fm_error *err);
void truth_jobs_free(fm_truth_jobs *jobs);

#endif
