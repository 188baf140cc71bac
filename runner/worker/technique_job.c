#include "technique_job.h"

#include <stdlib.h>
#include <xxhash.h>

#include "answer.h"
#include "base/clock.h"
#include "generators/generate.h"
#include "protocol.h"
#include "technique_internal.h"

static void add_cycles(cycles_frame *sum, const cycles_frame *more)
{
    for (size_t i = 0; i < CYCLES_VARIANT_COUNT; i++) {
        sum->geometry[i] += more->geometry[i];
        sum->raster[i] += more->raster[i];
    }
    for (size_t i = 0; i < sizeof sum->stages / sizeof sum->stages[0]; i++)
        sum->stages[i] += more->stages[i];
    sum->raster_b += more->raster_b;
    sum->signature_stall += more->signature_stall;
}

/* The baseline's frame is truth; a technique's is compared with it. *wrong: its wrong tiles. */
static fm_status check_frame(uint64_t *wrong, technique_run *run, const fm_frame *frame,
                             uint32_t index, fm_error *err)
{
    fm_technique_outcome *outcome = &run->outcome;
    fm_status status = FM_OK;
    *wrong = 0;
    if (run->job->method == NULL)
        technique_truth_add(&run->truth, run->gpu, index);
    else
        *wrong = technique_wrong_tiles(&run->truth, run->gpu, index);
    if (*wrong > 0) {
        if (outcome->wrong_frames++ == 0)
            outcome->first_wrong_frame = index;
        outcome->wrong_tiles += *wrong;
        status = technique_compare_frame(run, frame, index, err);
    }
    if (status == FM_OK)
        technique_keep_frame(run, *wrong);
    return status;
}

static void count_frame(technique_run *run, uint32_t index, uint64_t wrong)
{
    const tbr_counters *counts = tbr_counts(run->gpu);
    const cycles_frame time = cycles_of_frame(run->cycles, counts);
    const double spilled = cycles_spilled(&run->table.nominal, counts);
    const double all = time.geometry[CYCLES_NOMINAL] + time.raster[CYCLES_NOMINAL];
    const energy_result energy = technique_energy(run, counts, all, spilled, &run->table.nominal);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_CYCLES, all);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_ENERGY_NJ, energy.total);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_TILES_SKIPPED,
                      (double)counts->tiles_skipped);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_FRAGMENTS_SHADED,
                      (double)counts->fragments_shaded);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_WRONG_TILES, (double)wrong);
    run->outcome.fragments += counts->fragments_rasterised;
    if (index == 0)
        return;
    counters_add(&run->sum, counts);
    add_cycles(&run->cycle_sum, &time);
    run->spilled_sum += spilled * (double)(counts->attribute_bytes + counts->list_bytes);
}

static fm_status take_frame(technique_run *run, const fm_frame *frame, uint32_t index,
                            fm_error *err)
{
    const size_t bytes = (size_t)run->sequence->width_px * run->sequence->height_px * 4;
    uint64_t wrong;
    const fm_status status = check_frame(&wrong, run, frame, index, err);
    run->image_hash = XXH64(tbr_image(run->gpu), bytes, run->image_hash);
    if (status == FM_OK)
        count_frame(run, index, wrong);
    return status;
}

static fm_status run_frames(technique_run *run, fm_error *err)
{
    fm_status status = FM_OK;
    run->outcome.frames = run->sequence->frame_count;
    for (uint32_t i = 0; i < run->sequence->frame_count && status == FM_OK; i++) {
        const fm_frame *frame = NULL;
        status = run->sequence->frame(run->sequence, &frame, i, err);
        if (status == FM_OK)
            status = frame_check(frame, i, err);
        const bool is_ready = status == FM_OK;
        const double begin = clock_s();
        if (is_ready)
            status = tbr_frame(run->gpu, frame, err);
        if (is_ready && status == FM_INVALID && run->job->method != NULL) {
            run->outcome.is_techniques = true;
            status = fm_error_prefix(err, "%s: frame %u", run->job->method->id, i);
        }
        run->seconds +=
            i > 0 ? clock_s() - begin : 0; /* of the frames whose fragments are summed */
        if (status == FM_OK)
            status = take_frame(run, frame, i, err);
    }
    return status;
}

static fm_status finish(json_t *answer, technique_run *run, fm_error *err)
{
    fm_status status = FM_OK;
    if (run->job->method == NULL)
        status = text_write_file(run->job->truth, run->truth.bytes, run->truth.count, err);
    if (status != FM_OK)
        return status;
    technique_set_metrics(run);
    technique_set_errors(run);
    answer_set_image_hashes(answer, &run->image_hash, 1);
    answer_set_measured(answer, json_incref(run->metrics), json_incref(run->samples));
    technique_set_modelled(answer, run);
    return FM_OK;
}

static fm_status start(technique_run *run, fm_error *err)
{
    const fm_technique_job *job = run->job;
    const fm_method_desc *method = job->method;
    fm_status status = fm_error_refuse(
        err, model_table_read(&run->table, job->settings->model, err), FM_REASON_SETTING);
    if (status == FM_OK)
        status = fm_error_refuse(err, sequence_create(&run->sequence, job->settings, err),
                                 FM_REASON_SCENE);
    if (status != FM_OK)
        return status;
    const uint32_t side = FM_TILE_SIDE;
    const uint32_t across = (run->sequence->width_px + side - 1) / side;
    const uint32_t tiles = across * ((run->sequence->height_px + side - 1) / side);
    status = cycles_create(&run->cycles, &run->table, tiles, across, err);
    if (status != FM_OK)
        return status;
    if (method != NULL)
        run->parts = technique_parts(method, job->choices, job->choice_count);
    const tbr_desc desc = { .width_px = run->sequence->width_px,
                            .height_px = run->sequence->height_px,
                            .technique = method != NULL ? method->technique : NULL,
                            .mark = job->mark,
                            .parts = run->parts,
                            .binned = cycles_binned,
                            .rendered = cycles_rendered,
                            .context = run->cycles };
    status = tbr_create(&run->gpu, &desc, err);
    if (status == FM_OK)
        status = method == NULL ? technique_truth_make(run, err) : technique_truth_read(run, err);
    return status;
}

fm_status technique_job_run(json_t *answer, fm_technique_outcome *outcome,
                            const fm_technique_job *job, fm_error *err)
{
    technique_run run = { .job = job, .samples = json_array(), .metrics = json_object() };
    fm_status status = start(&run, err);
    if (status == FM_OK)
        status = technique_keep_begin(&run, err);
    if (status == FM_OK)
        status = run_frames(&run, err);
    status = technique_keep_end(&run, status, err);
    if (status == FM_OK)
        status = finish(answer, &run, err);
    *outcome = run.outcome;
    json_decref(run.samples);
    json_decref(run.metrics);
    free(run.truth.bytes);
    tbr_destroy(run.baseline);
    tbr_destroy(run.gpu);
    cycles_destroy(run.cycles);
    sequence_destroy(run.sequence);
    return status;
}
