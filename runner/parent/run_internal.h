/* What the files behind run.h share; nobody else includes it. From below:
 *   run_files.c   where files of a run lie
 *   run_step.c    one launch, or the capture of one truth, from request to row
 *   run.c         a run: what is left of it, its rounds, its end */
#ifndef FM_RUN_INTERNAL_H
#define FM_RUN_INTERNAL_H

#include "journal.h"
#include "launch.h"
#include "progress.h"
#include "results.h"
#include "run.h"
#include "truth_jobs.h"

typedef struct run_state {
    const fm_plan *plan;
    const fm_plugin_list *plugins;
    const fm_run_desc *desc;
    fm_journal *journal;
    fm_results *results;
    fm_truth_jobs truths;
    fm_text_index ids; /* of the plan's cases */
    fm_launcher launcher;
    fm_progress progress;
    uint32_t *order; /* [plan->count]: of the running round */
    int stop_signal;
    bool is_damaged;
} run_state;

/* run_files.c */
/* DIRECTORY/FOLDER/NAMEENDING, or DIRECTORY/FOLDERENDING where name is "". FM_INVALID: too long. */
fm_status run_path(char path[FM_PATH_MAX_BYTES], const run_state *run, const char *folder,
                   const char *name, const char *ending, fm_error *err);
/* FM_INVALID: a folder cannot be made, or holds results that no journal belongs to. */
fm_status run_make_folders(const run_state *run, fm_error *err);
/* What only running launches need. Folders that hold more stay. */
void run_remove_truths(const run_state *run);

/* run_step.c */
/* The case is to be launched, and not finished. */
bool run_is_pending(const run_state *run, size_t case_index);
/* Writes the end of a launch into journal, tables and, if it was the case's last, the summary. */
fm_status run_end_launch(run_state *run, size_t case_index, uint32_t launch, json_t *answer,
                         fm_error *err);
/* Captures a truth, unless an interrupted run left it. Where it cannot be had, all its cases end as
 * it did. FM_IO: a fault of the run's own files. */
fm_status run_capture_truth(run_state *run, size_t job, fm_error *err);
/* Launches a case. FM_IO: a fault of the run's own files; the launch stays unfinished. */
fm_status run_measure(run_state *run, size_t case_index, uint32_t launch, fm_error *err);

#endif
