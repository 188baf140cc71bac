/* The parent of a run: plans, launches workers in seeded rounds, keeps the journal, writes
 * manifest.json, samples.csv, summary.csv and images/ in a directory; resumable at any moment.
 *
 * In DIRECTORY/work lie the request, result and output of launches that went wrong, in
 * DIRECTORY/truth what launches are compared with, until the run is done.
 *
 * The room parent runs in the parent process only: it starts workers, never opens a device, and is
 * the only one that writes a run's files. */
#ifndef FM_RUN_H
#define FM_RUN_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "plan/plan.h"

typedef struct fm_run_desc {
    const char *directory; /* made; one that holds another run's journal is FM_INVALID */
    const char *command;   /* the command line, for the manifest */
    bool validation;       /* open devices with API validation */
    bool no_timers;
    bool no_images;
    bool
        is_fresh; /* rows of other code than is here now are measured anew; else they are refused */
    uint32_t timeout_s;         /* of one launch; 0 is 600 */
    uint64_t memory_bytes;      /* address-space limit of one launch; 0: none */
    FILE *progress;             /* NULL: silent */
    const char *worker;         /* executed as `WORKER worker REQUEST RESULT`; NULL: this program */
    const char *const *figures; /* ids that this run is for, for the report; ends with NULL */
} fm_run_desc;

/* Outcome of a run, for the exit code. */
typedef struct fm_run_result {
    uint32_t ok, not_supported, failed;
    uint32_t skipped;    /* not finished, because the run was interrupted */
    uint32_t noisy;      /* rows that are marked so in summary.csv */
    double waited_share; /* of the time that threads could have run in launches on software devices,
                            what they waited for a processor; NAN: unknown */
    double load;         /* greatest load average; NAN: unknown */
    int stop_signal;     /* SIGINT or SIGTERM that interrupted it, or 0 */
    bool is_damaged;     /* FM_IO because the journal is damaged or foreign */
    bool is_other_code;  /* FM_INVALID because a row was begun with other code than is here now */
} fm_run_result;

/* Runs all launches that an earlier run in the same directory has not finished. Before the first
 * one, each row of that run is compared with the code that is here now, finished ones too.
 * FM_INVALID: nothing was run: no floor method, the directory belongs to another plan, is in use,
 * or cannot be made; or is_other_code: the message says of which rows what changed, before
 * anything was launched or, where a file changed under the run, after the last launch that fits its
 * row. FM_IO: files cannot be written, a device of an earlier run cannot be opened, or is_damaged.
 * The run can be continued after every error but the damage. */
fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err);

#endif
