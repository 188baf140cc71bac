/* The parent of a run: plans, launches workers in seeded rounds, keeps the journal, writes
 * manifest.json, samples.csv, summary.csv and images/ in a directory; resumable at any moment.
 *
 * In DIRECTORY/work lie the request, result and output of launches that went wrong, in
 * DIRECTORY/truth what launches are compared with, until the run is done.
 *
 * Who is blamed. A case has a verdict only for what its own worker did while this process lived:
 * what the worker answers; no answer in time; or a worker that died, with no answer or a senseless
 * one, twice. The first death is written into the journal, and the launch is tried again; the
 * verdict on the second one tells of both. That this process died says nothing of the launch that
 * ran. Whatever the world does stops the run instead, and the launch stays unfinished: files that
 * cannot be written, a device that cannot be opened, processes that cannot be started, limits that
 * the run was given. So does a worker that somebody kills (SIGKILL, SIGTERM, SIGINT, SIGHUP, but
 * not the kernel for want of memory): the first time the launch is tried again, the second time the
 * run stops. A plugin that kills its own worker so looks the same: the message names the launch.
 * SIGINT, SIGTERM and SIGHUP interrupt the run, unless they are ignored (nohup), also where the
 * worker has them first.
 *
 * The room parent runs in the parent process only: it starts workers, never opens a device, and is
 * the only one that writes a run's files. */
#ifndef FM_RUN_H
#define FM_RUN_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/text.h"
#include "plan/plan.h"
#include "truth/kept_file.h"

typedef struct fm_run_desc {
    const char *directory; /* made; one that holds another run's journal is FM_INVALID */
    const char *command;   /* the command line, for the manifest */
    bool validation;       /* open devices with API validation */
    bool no_timers;
    bool no_images;
    uint32_t retried;   /* statuses, as bits 1u << fm_case_status: rows of an earlier run that
                           have them are measured anew, and the old ones forgotten */
    uint32_t kept;      /* what DIRECTORY/kept is to hold of each case, as bits 1u << kept_kind:
                           ID.fragments, ID.truth, ID.frames (truth/kept_file.h). Of rows that an
                           earlier run finished without, it is told how many lack which */
    bool is_fresh;      /* rows of other code than is here now are measured anew; else they are
                           refused */
    const char *cache;  /* folder of what other launches left (cache/cache.h); NULL or "": none */
    uint32_t timeout_s; /* of one launch; 0 is 600 */
    uint64_t memory_bytes; /* address-space limit of one launch; 0: none */
    FILE *progress;        /* NULL: silent */
    FILE *talk;            /* for what is told also without progress: which rows of an earlier run
                              are forgotten, and why; NULL: nothing is */
    const char *worker;    /* executed as `WORKER worker REQUEST RESULT`; NULL: this program */
    /* Of its sources, and that built it, for the manifest; NULL: this program's. */
    const char *worker_commit, *worker_compiler;
    const char *const *figures;  /* ids that this run is for, for the report; ends with NULL */
    const fm_text *figure_cases; /* figures.csv: which case is for which of them; NULL: none */
} fm_run_desc;

/* Outcome of a run, for the exit code. */
typedef struct fm_run_result {
    bool is_counted; /* else the run failed before it knew what an earlier one left, and the
                        counts of rows say nothing */
    uint32_t ok, not_supported, failed;
    uint32_t forgotten;  /* rows of an earlier run, to be measured anew */
    uint32_t skipped;    /* not finished, because the run was interrupted */
    uint32_t noisy;      /* rows that are marked so in summary.csv */
    double waited_share; /* of the time that threads could have run in launches on software devices,
                            what they waited for a processor; NAN: unknown */
    double load;         /* greatest load average; NAN: unknown */
    int stop_signal;     /* SIGINT, SIGTERM or SIGHUP that interrupted it, or 0 */
    bool is_damaged;     /* FM_IO because the journal is damaged or foreign */
    bool is_other_code;  /* FM_INVALID because a row was begun with other code than is here now */
} fm_run_result;

/* Runs all launches that an earlier run in the same directory has not finished. Before the first
 * one, each row of that run is compared with the code that is here now, finished ones too.
 * FM_INVALID: nothing was run: no floor method, the directory belongs to another plan, is in use,
 * or cannot be made or written; or is_other_code: the message says of which rows what changed,
 * before anything was launched or, where a file changed under the run, after the last launch that
 * fits its row. FM_IO: files cannot be written, a device of an earlier run cannot be opened, the
 * world stopped the run, or is_damaged. The run can be continued after every error but the damage.
 */
fm_status run_cases(fm_run_result *result, const fm_plan *plan, const fm_plugin_list *plugins,
                    const fm_run_desc *desc, fm_error *err);

#endif
