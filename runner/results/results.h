/* What was measured so far, and its two tables: samples.csv grows by whole launches, summary.csv is
 * written anew, atomically, when cases are finished; of large runs not after each of them. */
#ifndef FM_RESULTS_H
#define FM_RESULTS_H

#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>

#include "base/error.h"
#include "base/text.h"
#include "bound/limits.h"
#include "code/codes.h"
#include "model/columns.h"
#include "model/outcome.h"
#include "plan/plan.h"

/* The frame of a number that holds for a launch as a whole (FM_OF_LAUNCH). */
#define FM_FRAME_NONE UINT32_MAX

/* One value of a metric of a frame or launch. Those of families only pass into samples.csv. */
typedef struct fm_kept_sample {
    double value;
    uint32_t launch, frame;
    fm_metric metric;
} fm_kept_sample;

typedef struct fm_launch_state {
    char *death; /* how its worker died the first time; NULL: it has not */
    bool is_done;
} fm_launch_state;

typedef struct fm_case_result {
    fm_case_status status;     /* the worst so far */
    fm_reason reason;          /* of that status */
    char message[2048];        /* the same */
    fm_launch_state *launches; /* [plan->launches] */
    uint32_t done;             /* launches that ended */
    bool is_enough;            /* whoever chooses the launches wants no more of them */
    uint32_t wanted;           /* launches after which it is finished */
    uint64_t *images;          /* [image_count]: hashes of different images, of all timed frames */
    size_t image_count;
    fm_kept_sample *samples;
    size_t sample_count, sample_room;
    json_t *metrics;  /* of the checked launch; NULL before it */
    json_t *modelled; /* the same */
    char device_name[128], device_driver[128], device_api[64];
    bool has_gpu_clock, is_software;
    char *row;     /* of summary.csv, kept until the case changes */
    size_t device; /* among fastest_canary_ns */
} fm_case_result;

typedef struct fm_results {
    const fm_plan *plan;
    const fm_plugin_list *plugins;
    fm_case_result *cases;        /* [plan->count] */
    fm_codes codes;               /* what the cases were measured by */
    json_t *meshes;               /* by file: what was loaded, as answers say it */
    const fm_limits_list *limits; /* of devices, for what a case needs at least; borrowed; NULL:
                                     none are known. Whoever creates results sets it before rows are
                                     written, and the next */
    fm_limits_key host;           /* its cpu and cores */
    double *fastest_canary_ns;    /* of each device of the plan; INFINITY: none so far */
    /* Of summary.csv: */
    size_t unwritten; /* cases that were finished since it was written */
    double written_at_s, took_s;
    char summary_path[FM_PATH_MAX_BYTES], samples_path[FM_PATH_MAX_BYTES];
    char new_path[FM_PATH_MAX_BYTES]; /* samples.csv while a journal is replayed; "": no more */
    char run_id[17];
    int samples_fd;
} fm_results;

/* plan and plugins are borrowed for the life of the results. Cases that are not to be launched
 * have their status at once. samples.csv is begun anew, beside the one that there is, until
 * results_keep_replayed. */
fm_status results_create(fm_results **results, const fm_plan *plan, const fm_plugin_list *plugins,
                         const char *directory, const char *run_id, fm_error *err);
void results_destroy(fm_results *results);
/* The journal was understood: what it told takes the place of the samples.csv that there was. */
fm_status results_keep_replayed(fm_results *results, fm_error *err);

/* Takes one launch's answer (protocol.h): status, samples, metrics; appends its rows. */
fm_status results_add(fm_results *results, size_t case_index, uint32_t launch, const json_t *answer,
                      fm_error *err);

/* Keeps what an answer says of a mesh. True: it is the first to say it of this file. */
bool results_take_mesh(fm_results *results, const json_t *answer);

/* So many launches of the case are enough: fewer than were planned. */
void results_want(fm_results *results, size_t case_index, uint32_t launches);

/* No further launch of this case is wanted. */
bool results_is_finished(const fm_results *results, size_t case_index);

/* Writes summary.csv: a row for each case that was launched or is not to be. */
fm_status results_write_summary(fm_results *results, fm_error *err);

/* For a case that was just finished: writes summary.csv, but leaves it as it is, for the next call
 * or the end of the run, where less than 1/64 of the cases were finished since it was written and
 * less than 2 s, or 20 times as long as writing took, have gone by. So all writing together stays
 * in proportion to the cases, and the journal has what the file lacks. now_s: of clock_s. */
fm_status results_write_summary_if_due(fm_results *results, double now_s, fm_error *err);

/* Once, at the end of a run. Slow clocks are known only now: samples off full clock are marked in
 * samples.csv, by a row with metric off_clock for their launch and frame, and all rows of
 * summary.csv are renewed without them. Cases that had no turn get a row with status skipped. */
fm_status results_end(fm_results *results, fm_error *err);

/* Sets is_off_clock[launch * frames + frame] of each sample of the case whose canary was slow. */
void summary_off_clock(bool *is_off_clock, const fm_results *results, size_t case_index);
/* The names of the columns, and one row; both with their end of line. */
void summary_header(fm_text *text);
void summary_row(fm_text *text, const fm_results *results, size_t case_index);
/* The case has times, and its device no limits. */
bool summary_lacks_limits(const fm_results *results, size_t case_index);
/* Column `noisy` of that row: noise.h. */
void summary_noise(fm_text *text, const fm_results *results, size_t case_index);
/* How far the row's frame_ms is known: half of its interval over it. NAN: there is no interval;
 * *has_times: whether a frame has a time at all. FM_NO_MEMORY. */
fm_status summary_half_width(double *half_width, bool *has_times, const fm_results *results,
                             size_t case_index, fm_error *err);

#endif
