/* Where two runs were made: whether milliseconds of one mean anything beside those of the other. */
#ifndef FM_COMPARE_MACHINES_H
#define FM_COMPARE_MACHINES_H

#include <stdbool.h>

#include "join.h"

/* A line of the manifests, or a device of the rows, that differs; "": that run does not tell. */
typedef struct fm_machine_fact {
    char name[96];          /* "cpu", "vulkan driver", "git_commit" */
    const char *base, *now; /* texts of the runs */
} fm_machine_fact;

typedef struct fm_machines {
    fm_machine_fact *differing; /* [count]; owned */
    size_t count;
    /* Same hardware (model/hardware.h), and names of the devices that both manifests list, and of
     * each case that has times in both runs. What one run does not tell is not the same. Drivers
     * and kernels may differ: they are what may have become slower. */
    bool is_same_machine;
    bool is_same_day; /* both began on the same day, UTC */
} fm_machines;

/* All borrowed. */
typedef struct fm_machines_desc {
    const fm_result_files *base, *now;
    const fm_pairs *pairs; /* of their cases */
} fm_machines_desc;

/* Compares machines and devices, versions, and how launches were made. The runs must outlive
 * *machines, which the caller frees. FM_NO_MEMORY. */
fm_status machines_compare(fm_machines *machines, const fm_machines_desc *desc, fm_error *err);
void machines_free(fm_machines *machines);

#endif
