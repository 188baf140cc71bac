/* manifest.json: what was run, with what, where. */
#ifndef FM_MANIFEST_H
#define FM_MANIFEST_H

#include "results/results.h"
#include "run.h"

typedef struct fm_manifest_desc {
    const fm_run_desc *run;
    const fm_results *results;
    const char *started; /* UTC, of the run's first process */
    bool is_ended;       /* now is when it ended */
} fm_manifest_desc;

/* Writes DIRECTORY/manifest.json anew, atomically. */
fm_status manifest_write(const fm_manifest_desc *desc, fm_error *err);

/* The commit of the sources of this program; "" when unknown. */
const char *manifest_commit(void);

/* A method's descriptor for readers of results: title, citation, version, family, marker, dashed,
 * traits, and the defaults of its options. NULL without memory. */
json_t *method_json(const fm_method_desc *method, const fm_plan *plan);

#endif
