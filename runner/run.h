/* The parent of a run: plans, launches workers in seeded rounds, keeps the journal, writes
 * manifest.json, samples.csv, summary.csv and images/ in a directory; resumable at any moment. */
#ifndef FM_RUN_H
#define FM_RUN_H

#include <stdbool.h>
#include <stdint.h>

#include "error.h"
#include "plan.h"

typedef struct fm_run_desc {
    const char *directory;   /* made; one that holds another run's journal is FM_INVALID */
    const char *command;     /* the command line, for the manifest */
    bool validation;         /* open devices with API validation */
    bool no_timers;
    bool no_images;
    uint32_t timeout_s;      /* of one launch; 0 is 600 */
    uint64_t memory_bytes;   /* address-space limit of one launch; 0: none */
    bool quiet;
} fm_run_desc;

/* Outcome of a run, for the exit code. */
typedef struct fm_run_result {
    uint32_t ok, not_supported, failed, skipped;
    bool interrupted;
} fm_run_result;

fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err);

#endif
