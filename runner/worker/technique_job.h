/* A launch whose feed is `frames`: a technique runs a whole sequence on the simulated GPU.
 *
 * The answer gets (protocol.h) image_hashes: one, of all frames; samples of each frame:
 * frame.cycles, frame.energy_nj, frame.tiles_skipped, frame.fragments_shaded, frame.wrong_tiles;
 * and metrics.
 *
 * Metrics that are sums over all frames but the first, in which no technique has anything to go by:
 * every counter of simulator/counters.h by its name; fragments_generated; cycles, cycles.geometry,
 * cycles.raster, cycles.signature_stall, cycles.raster_b (the other form), cycles.STAGE (busy
 * cycles of the raster stages), cycles.VARIANT (models/cycles.h); energy_nj, energy.COMPONENT_nj,
 * energy_corner.NAME_nj (models/energy.h).
 *
 * Metrics against the baseline's images, over all frames: wrong_tiles, wrong_frames, rmse, psnr_db,
 * max_abs and ssim (model/metrics.c). And how fast the simulation was:
 * simulated_fragments_per_core_s. */
#ifndef FM_TECHNIQUE_JOB_H
#define FM_TECHNIQUE_JOB_H

#include <jansson.h>

#include "model/settings.h"
#include "plugin/hook_mark.h"
#include "simulator/technique.h"

typedef struct fm_technique_job {
    const fm_method_desc *method; /* NULL: the baseline, whose images are the truth */
    const fm_settings *settings;  /* finished */
    const fm_choice *choices;
    size_t choice_count;
    fm_hook_mark *mark; /* told where its hooks are called; NULL: nobody asks */
    const char *truth;  /* file: written by the baseline, else read */
    const char *image;  /* file for the first frame that is not the baseline's; "": none */
    const char *keep; /* file for the wrong tiles of all frames and the pictures of the first wrong
                         ones (truth/kept_file.h); NULL or "": none */
    uint64_t kept_bytes; /* most of these pictures; 0: TECHNIQUE_KEPT_BYTES */
} fm_technique_job;

#define TECHNIQUE_KEPT_BYTES (128ull << 20)

/* What became of a sequence. */
typedef struct fm_technique_outcome {
    uint32_t frames;
    uint64_t fragments;   /* rasterised, of all frames with the first */
    uint64_t wrong_tiles; /* of all frames: their colours are not the baseline's */
    uint32_t wrong_frames, first_wrong_frame; /* frames with such a tile, counted from 0 */
    bool is_techniques;                       /* it failed by what a hook answered */
} fm_technique_outcome;

/* FM_UNSUPPORTED: a sequence or a model that cannot be had.
 * FM_INVALID: a frame that the simulator does not take, or what a hook answers. FM_IO: the truth,
 * the image or what is kept cannot be read or written.
 */
fm_status technique_job_run(json_t *answer, fm_technique_outcome *outcome,
                            const fm_technique_job *job, fm_error *err);

#endif
