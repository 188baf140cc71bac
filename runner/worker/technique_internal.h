/* What the files behind technique_job.h share; nobody else includes it. From below:
 *   technique_truth.c    the baseline's tiles: made, read, compared with, and kept where wrong
 *   technique_error.c    how far the wrong frames are from the baseline's
 *   technique_metrics.c  counts, cycles and energy of a sequence as metrics
 *   technique_job.c      the run of a sequence */
#ifndef FM_TECHNIQUE_INTERNAL_H
#define FM_TECHNIQUE_INTERNAL_H

#include "image/image.h"
#include "simulator/models/cycles.h"
#include "simulator/models/energy.h"
#include "simulator/tbr.h"
#include "technique_job.h"
#include "truth/kept_file.h"

/* The baseline's images: a hash for each tile of each frame. */
typedef struct sequence_truth_header {
    char magic[8];
    uint32_t width_px, height_px, frame_count, tile_count;
} sequence_truth_header;

typedef struct sequence_truth {
    char *bytes;
    size_t count;
    sequence_truth_header header;
} sequence_truth;

/* Sums over the wrong frames; squares: of rmse. */
typedef struct technique_errors {
    double squares, max_abs, ssim, flip, flip_max;
} technique_errors;

/* All of a run. */
typedef struct technique_run {
    const fm_technique_job *job;
    json_t *samples, *metrics;
    fm_sequence *sequence;
    tbr *gpu;
    cycles *cycles;
    model_table table;
    uint32_t parts;
    sequence_truth truth;
    tbr_counters sum;
    cycles_frame cycle_sum;
    double spilled_sum; /* weighted by the parameter buffer's bytes */
    fm_technique_outcome outcome;
    tbr *baseline; /* once a frame was wrong, to draw it */
    technique_errors errors;
    uint64_t image_hash; /* of the frames so far */
    kept_writer kept;
    kept_tile *kept_tiles; /* [tiles]: of one frame; NULL: nothing is kept */
    double seconds;
} technique_run;

/* technique_truth.c */
/* Room for the truth of this sequence, which the baseline's frames fill. FM_NO_MEMORY. */
fm_status technique_truth_make(technique_run *run, fm_error *err);
/* FM_IO: it cannot be read, or is another sequence's. */
fm_status technique_truth_read(technique_run *run, fm_error *err);
/* Takes the frame that the baseline has drawn. */
void technique_truth_add(const sequence_truth *truth, const tbr *gpu, uint32_t frame);
/* How many tiles of the frame that the GPU has drawn are not the truth's. */
uint64_t technique_wrong_tiles(const sequence_truth *truth, const tbr *gpu, uint32_t frame);

/* Begins the file of job->keep, if that is given. technique_keep_end in any case. */
fm_status technique_keep_begin(technique_run *run, fm_error *err);
/* The next frame; of one with wrong tiles the baseline has drawn its own. */
void technique_keep_frame(technique_run *run, uint64_t wrong_tiles);
/* As kept_finish. */
fm_status technique_keep_end(technique_run *run, fm_status status, fm_error *err);

/* technique_error.c */
/* Adds a wrong frame's errors; of the first of them, the picture and its truth are written. FM_IO:
 * that failed, or the truth is another sequence's. */
fm_status technique_compare_frame(technique_run *run, const fm_frame *frame, uint32_t index,
                                  fm_error *err);
/* Image errors of the sequence, wrong tiles and frames, as metrics. */
void technique_set_errors(technique_run *run);

/* technique_metrics.c */
energy_result technique_energy(const technique_run *run, const tbr_counters *counters,
                               double all_cycles, double spilled, const model_parameters *p);
void technique_set_metrics(technique_run *run);
/* Which parts of the simulator ran for this technique and sequence. */
void technique_set_modelled(json_t *answer, const technique_run *run);

#endif
