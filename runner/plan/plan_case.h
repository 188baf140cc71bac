/* One case of a plan: its settings, why it cannot run, its id. */
#ifndef FM_PLAN_CASE_H
#define FM_PLAN_CASE_H

#include "plan.h"
#include "selection.h"

/* The digest of the mesh met last: cases of one scene follow one another. */
typedef struct fm_mesh_memo {
    const char *path; /* of text_shared; NULL: none yet */
    uint64_t digest;
    fm_error error; /* status FM_OK: the digest is known */
} fm_mesh_memo;

/* What one device is, asked when the first case wants it. */
typedef struct fm_device_memo {
    const fm_plan_request *request; /* with whom to ask */
    bool was_asked;
    fm_auto_device device;
    fm_error error; /* status FM_OK: the device is known */
} fm_device_memo;

/* Where in the product a case stands. All borrowed. */
typedef struct fm_plan_point {
    const fm_plugin_entry *entry;
    const char *scene, *device, *feed;
    const fm_device_ops *ops; /* of the device */
    const fm_settings *base;  /* the scene's own */
    const fm_selection *selection;
    const size_t *values;        /* [sweep_count]: which value of each axis */
    fm_mesh_memo *memo;          /* starts as {0} */
    fm_device_memo *device_memo; /* of the device; NULL: nobody can be asked */
} fm_plan_point;

/* Makes the case, which the caller releases. FM_INVALID: the point's keys contradict each other;
 * FM_NO_MEMORY. Nothing is to be released after a failure. */
fm_status plan_case_make(fm_case *made, const fm_plan_point *point, fm_error *err);
void plan_case_release(fm_case *made);

#endif
