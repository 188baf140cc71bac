/* What the files behind run.h share; nobody else includes it. From below:
 *   run_files.c   where files of a run lie
 *   run_request.c what workers are asked for a case
 *   run_attempt.c a worker, asked again where it died
 *   run_code.c    whether rows and truths were made by the code that is here now
 *   run_range.c   what all images of a case reach, over its launches
 *   run_look.c    whether cases that are compared were launched often enough
 *   run_step.c    one launch, or the capture of one truth, from request to row
 *   run_resume.c  what an earlier run left, from its journal
 *   run.c         a run: what is left of it, its rounds, its end */
#ifndef FM_RUN_INTERNAL_H
#define FM_RUN_INTERNAL_H

#include "code/code_now.h"
#include "launch.h"
#include "progress.h"
#include "results/journal.h"
#include "results/results.h"
#include "run.h"
#include "truth_jobs.h"
#include "worker/protocol.h"

/* Cases that charts compare, which are launched equally often: of one scene, device and feed. */
typedef struct run_look_group {
    uint32_t last;    /* launches at the last look */
    uint32_t decided; /* at the latest one at which it was decided; 0: none */
    bool has_enough;  /* there */
    double precision_percent;
} run_look_group;

typedef struct run_looks {
    run_look_group *groups; /* [count] */
    size_t count;
    size_t *of_case; /* [plan->count]; RUN_NO_GROUP: its launches are a fixed number */
    uint32_t *told;  /* [plan->count]: the latest look that the journal has a line of for it */
} run_looks;
#define RUN_NO_GROUP SIZE_MAX

typedef struct fm_open_run run_state;
struct fm_open_run {
    const fm_plan *plan;
    const fm_plugin_list *plugins;
    const fm_run_desc *desc;
    fm_journal *journal;
    fm_results *results;
    fm_limits_list limits; /* of devices, as they were calibrated before the run */
    fm_truth_jobs truths;
    run_looks looks;
    fm_text_index ids; /* of the plan's cases */
    fm_stop_signals signals;
    fm_codes codes;   /* of the journal, as it was found; forgets of what it is to forget */
    json_t *drivers;  /* by device as cases name it: hash of its driver now, for those that were
                         opened */
    uint64_t program; /* hash of what workers execute */
    fm_progress progress;
    uint32_t *order; /* [plan->count]: of the running round */
    uint32_t forgotten;
    int stop_signal;
    bool is_resumed;    /* results hold all that an earlier run left */
    bool hears_signals; /* they are open */
    bool is_damaged, is_other_code;
};

/* run_files.c */
/* DIRECTORY/FOLDER/NAMEENDING, or DIRECTORY/FOLDERENDING where name is "". FM_INVALID: too long. */
fm_status run_path(char path[FM_PATH_MAX_BYTES], const run_state *run, const char *folder,
                   const char *name, const char *ending, fm_error *err);
/* FM_INVALID: a folder cannot be made, or holds results that no journal belongs to. */
fm_status run_make_folders(const run_state *run, fm_error *err);
/* Writes that what the journal has of a case counts no more, and removes its images and what was
 * kept. */
fm_status run_forget(run_state *run, size_t case_index, fm_error *err);
/* Where what is kept of a case lies; "": it has none of this kind, or it was not asked for. */
fm_status run_kept_path(char path[FM_PATH_MAX_BYTES], const run_state *run, size_t case_index,
                        kept_kind kind, fm_error *err);
/* Tells of which finished rows nothing was kept, although it is asked for, and what no case has. */
void run_tell_unkept(run_state *run);
/* What only running launches need. Folders that hold more stay. */
void run_remove_truths(const run_state *run);
/* Those two folders, where they are empty. */
void run_remove_folders(const run_state *run);

/* run_request.c */
/* The case of a line in the journal. FM_INVALID: the plan has no such case, or launch of it. */
fm_status run_find_case(size_t *case_index, const run_state *run, const char *id, uint32_t launch,
                        fm_error *err);
/* The path of the plugin that measures a case; "": it was refused. */
const char *run_plugin_path(const run_state *run, const fm_case *planned);
/* What a truth job and the launches that are compared with it are asked alike. */
fm_request run_request_for(const run_state *run, const fm_case *planned, size_t job,
                           const char *truth);
/* How many frames a launch may speak of: those that are timed, or those of its sequence. */
uint32_t run_frames(const run_state *run, const fm_settings *settings);
/* The hash of a device's driver, of those that were opened; 0: not known. */
uint64_t run_known_driver(const run_state *run, const char *device);
/* Where the code of a case is now. */
fm_code_places run_code_places(const run_state *run, size_t case_index);
/* Puts into the answer of a worker that died what it may have read. */
void run_guess_code(const run_state *run, size_t case_index, json_t *answer);

/* run_attempt.c */
#define RUN_NO_CASE SIZE_MAX
typedef struct run_attempt {
    const char *name;    /* of its files in DIRECTORY/work */
    const char *current; /* for people */
    const fm_request *request;
    size_t case_index; /* RUN_NO_CASE: a truth's, of which the journal knows nothing */
    uint32_t launch;
} run_attempt;
/* Asks a worker, and asks once more where it died, or where a lock gave up on a busy machine: run.h
 * says who is blamed for what. *death: how it died the first time, perhaps under an earlier parent;
 * NULL: it has not; owned by the caller. FM_OK: outcome->kind is no FM_LAUNCH_KILLED, and the
 * result of a second death tells of both. FM_IO: a fault of the run's own files, or the worker was
 * killed twice from outside; then there is no result. */
fm_status run_attempt_launch(fm_launch_outcome *outcome, run_state *run, const run_attempt *attempt,
                             char **death, fm_error *err);

/* run_code.c */
/* Hears the journal first: checks each line, and notes what its rows were measured by, and how
 * much of them is to be forgotten. */
fm_status run_read_codes(run_state *run, fm_error *err);
/* Compares that with what is here now: refuses with is_other_code, or with is_fresh writes into the
 * journal that they are to be forgotten. */
fm_status run_check_codes(run_state *run, fm_error *err);
/* Puts into the answer what it may have read, if it says nothing, and compares it with what the row
 * was measured by. FM_INVALID: is_other_code. */
fm_status run_fit_code(run_state *run, size_t case_index, json_t *answer, fm_error *err);
/* Whether the truth at path is there, and was captured by what is here now. Else nothing is left of
 * it: what lies beside a truth would be taken for the next one's. */
fm_status run_find_truth(bool *is_there, run_state *run, size_t job, const char *path,
                         fm_error *err);
/* Keeps beside a truth what captured it. */
fm_status run_keep_truth_code(const run_state *run, const char *path, const json_t *answer,
                              fm_error *err);

/* run_range.c */
/* Where a launch writes what its new images reach (image/image_range.h); "": images are not kept.
 */
fm_status run_range_path(char path[FM_PATH_MAX_BYTES], const run_state *run, size_t case_index,
                         fm_error *err);
/* Takes that into images/ID.low.rgba32f and .high.rgba32f, which are of all launches, and not there
 * where all drew one image; or leaves it out, where the launch does not count. Nothing is left of
 * the launch's own. FM_IO. */
fm_status run_take_range(const run_state *run, size_t case_index, uint32_t launch, bool is_counted,
                         fm_error *err);

/* run_look.c */
/* The groups, of which nothing is decided. After truth_jobs_create. FM_NO_MEMORY. */
fm_status run_looks_create(run_state *run, fm_error *err);
void run_looks_free(run_looks *looks);
/* Takes a decision of an earlier process. FM_INVALID: there is no such look, or its group decided
 * otherwise. */
fm_status run_look_replay(run_state *run, size_t case_index, uint32_t launch, bool is_enough,
                          fm_error *err);
/* FM_INVALID: the group of the case had enough before that launch. */
fm_status run_look_allows(const run_state *run, size_t case_index, uint32_t launch, fm_error *err);
/* What was decided, once all of the journal is known: no more launches where there were enough. */
void run_looks_apply(run_state *run);
/* Before a round: decides for the groups that have a look after so many launches, and writes it
 * into the journal before anything is launched by it. FM_IO, FM_NO_MEMORY. */
fm_status run_look(run_state *run, uint32_t launch, fm_error *err);

/* run_step.c */
/* The case is to be launched, and not finished. */
bool run_is_pending(const run_state *run, size_t case_index);
/* Captures a truth, unless an interrupted run left it. Where it cannot be had, all its cases end as
 * it did. FM_IO: a fault of the run's own files. */
fm_status run_capture_truth(run_state *run, size_t job, fm_error *err);
/* Launches a case. FM_IO: a fault of the run's own files; the launch stays unfinished. */
fm_status run_measure(run_state *run, size_t case_index, uint32_t launch, fm_error *err);

/* run_resume.c */
/* Opens the journal, and takes from it what was measured and is still to count. */
fm_status run_resume(run_state *run, fm_error *err);

#endif
