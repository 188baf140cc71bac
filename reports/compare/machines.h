/* Where two runs were made: whether milliseconds of one mean anything beside those of the other. */
#ifndef FM_COMPARE_MACHINES_H
#define FM_COMPARE_MACHINES_H

#include <stdbool.h>

#include "read/provenance.h"

/* A line of the manifests that differs; "": that run does not tell. */
typedef struct fm_machine_fact {
    char name[96]; /* "cpu", "vulkan driver", "git_commit" */
    const char *base, *now;
} fm_machine_fact;

typedef struct fm_machines {
    fm_machine_fact *differing; /* [count]; texts are the manifests' */
    size_t count;
    /* Same hardware (hardware.h) and devices' names. What two runs do not tell is not the same.
     * Drivers and kernels may differ: they are what may have become slower. */
    bool is_same_machine;
    bool is_same_day; /* both began on the same day, UTC */
} fm_machines;

/* Compares the manifests' machines and devices, versions, and how launches were made. The manifests
 * must outlive *machines, which the caller frees. FM_NO_MEMORY. */
fm_status machines_compare(fm_machines *machines, const fm_provenance *base,
                           const fm_provenance *now, fm_error *err);
void machines_free(fm_machines *machines);

#endif
