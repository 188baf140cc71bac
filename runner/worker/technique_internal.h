/* What the files behind technique_job.h share; nobody else includes it. From below:
 *   technique_truth.c    the baseline's images: made, read, and compared with
 *   technique_metrics.c  counts, cycles and energy of a sequence as metrics
 *   technique_job.c      the run of a sequence */
#ifndef FM_TECHNIQUE_INTERNAL_H
#define FM_TECHNIQUE_INTERNAL_H

#include "simulator/models/cycles.h"
#include "simulator/models/energy.h"
#include "simulator/tbr.h"
#include "technique_job.h"

/* The baseline's images: a hash for each tile of each frame, and the last frame's pixels. */
typedef struct sequence_truth_header {
    char magic[8];
    uint32_t width_px, height_px, frame_count, tile_count;
} sequence_truth_header;

typedef struct sequence_truth {
    char *bytes;
    size_t count;
    sequence_truth_header header;
} sequence_truth;

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
    uint64_t wrong_tiles, wrong_frames;
    double seconds;
} technique_run;

/* technique_truth.c */
/* Room for the truth of this sequence, which the baseline's frames fill. FM_NO_MEMORY. */
fm_status technique_truth_make(technique_run *run, fm_error *err);
/* FM_IO: it cannot be read, or is another sequence's. */
fm_status technique_truth_read(technique_run *run, fm_error *err);
/* The last frame's RGBA8 pixels in the truth. */
char *technique_truth_pixels(const sequence_truth *truth);
/* How many tiles of the frame differ from the truth; 0 for the baseline, which makes it. */
uint64_t technique_check_frame(technique_run *run, uint32_t frame);
/* Errors of the last frame's picture, as metrics; its image is written only where it differs. */
fm_status technique_compare_last(technique_run *run, fm_error *err);

/* technique_metrics.c */
energy_result technique_energy(const technique_run *run, const tbr_counters *counters,
                               double all_cycles, double spilled, const model_parameters *p);
void technique_set_metrics(technique_run *run);
/* Which parts of the simulator ran for this technique and sequence. */
void technique_set_modelled(json_t *answer, const technique_run *run);

#endif
