#include "technique_job.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "answer.h"
#include "base/clock.h"
#include "base/image.h"
#include "generators/generate.h"
#include "protocol.h"
#include "simulator/models/cycles.h"
#include "simulator/models/energy.h"
#include "simulator/tbr.h"

enum { TRUTH_MAX_BYTES = 1 << 30, NAME_BYTES = 96 };
static const char truth_magic[8] = "fmtbr 1";

/* The baseline's images: a hash for each tile of each frame, and the last frame's pixels. */
typedef struct truth_header {
    char magic[8];
    uint32_t width_px, height_px, frame_count, tile_count;
} truth_header;

typedef struct truth_file {
    char *bytes;
    size_t count;
    truth_header header;
} truth_file;

/* All of a run. */
typedef struct run_state {
    const fm_technique_job *job;
    json_t *samples, *metrics;
    fm_sequence *sequence;
    tbr *gpu;
    cycles *cycles;
    model_table table;
    uint32_t parts;
    truth_file truth;
    tbr_counters sum;
    cycles_frame cycle_sum;
    double spilled_sum; /* weighted by the parameter buffer's bytes */
    uint64_t wrong_tiles, wrong_frames;
    double seconds;
} run_state;

/* ---- truth ---- */

static size_t truth_bytes(const truth_header *header)
{
    return sizeof *header + (size_t)header->frame_count * header->tile_count * 8 +
           (size_t)header->width_px * header->height_px * 4;
}

static uint64_t *truth_hashes(const truth_file *truth, uint32_t frame)
{
    return (uint64_t *)(void *)(truth->bytes + sizeof truth->header) +
           (size_t)frame * truth->header.tile_count;
}

static char *truth_pixels(const truth_file *truth)
{
    return (char *)truth_hashes(truth, truth->header.frame_count);
}

static truth_header expected_header(const run_state *run)
{
    truth_header header = { .width_px = run->sequence->width_px,
                            .height_px = run->sequence->height_px,
                            .frame_count = run->sequence->frame_count,
                            .tile_count = tbr_tile_count(run->gpu) };
    memcpy(header.magic, truth_magic, sizeof header.magic);
    return header;
}

static fm_status make_truth(run_state *run, fm_error *err)
{
    run->truth.header = expected_header(run);
    run->truth.count = truth_bytes(&run->truth.header);
    run->truth.bytes = calloc(1, run->truth.count);
    if (run->truth.bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "truth: %zu bytes", run->truth.count);
    memcpy(run->truth.bytes, &run->truth.header, sizeof run->truth.header);
    return FM_OK;
}

static fm_status read_truth(run_state *run, fm_error *err)
{
    const truth_header expected = expected_header(run);
    const char *path = run->job->truth;
    fm_status status =
        text_read_file(&run->truth.bytes, &run->truth.count, path, TRUTH_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    if (run->truth.count != truth_bytes(&expected) ||
        memcmp(run->truth.bytes, &expected, sizeof expected) != 0)
        return fm_fail(err, FM_IO, "%s: not the truth of this sequence", path);
    run->truth.header = expected;
    return FM_OK;
}

static uint64_t hash_tile(const run_state *run, uint32_t tile)
{
    const uint32_t across = tbr_tiles_across(run->gpu), width = run->sequence->width_px;
    const uint32_t x = tile % across * FM_TILE_SIDE, y = tile / across * FM_TILE_SIDE;
    const uint32_t columns = width - x < FM_TILE_SIDE ? width - x : FM_TILE_SIDE;
    const uint32_t left = run->sequence->height_px - y;
    uint64_t hash = 0;
    for (uint32_t row = 0; row < (left < FM_TILE_SIDE ? left : FM_TILE_SIDE); row++)
        hash = XXH64(tbr_image(run->gpu) + (size_t)(y + row) * width + x, 4 * columns, hash);
    return hash;
}

/* How many tiles differ from the truth; or, for the baseline, makes it. */
static uint64_t check_frame(run_state *run, uint32_t frame)
{
    uint64_t *hashes = truth_hashes(&run->truth, frame), wrong = 0;
    for (uint32_t tile = 0; tile < run->truth.header.tile_count; tile++) {
        const uint64_t hash = hash_tile(run, tile);
        if (run->job->method == NULL)
            hashes[tile] = hash;
        else
            wrong += hash != hashes[tile];
    }
    return wrong;
}

/* ---- images ---- */

/* A frame buffer is opaque: what it shows, as linear floats. */
static fm_status float_image(fm_image **image, const run_state *run, const uint32_t *pixels,
                             fm_error *err)
{
    const size_t count = (size_t)run->sequence->width_px * run->sequence->height_px;
    const fm_status status =
        image_create(image, run->sequence->width_px, run->sequence->height_px, err);
    for (size_t i = 0; status == FM_OK && i < count; i++) {
        for (unsigned c = 0; c < 3; c++)
            (*image)->rgba[4 * i + c] = (float)(pixels[i] >> 8 * c & 255) / 255.0f;
        (*image)->rgba[4 * i + 3] = 1.0f;
    }
    return status;
}

static void set_errors(json_t *metrics, const fm_image_error *error)
{
    answer_set_number(metrics, FM_METRIC_RMSE, error->rmse);
    answer_set_number(metrics, FM_METRIC_MAX_ABS, error->max_abs);
    answer_set_number(metrics, FM_METRIC_SSIM, error->ssim);
    answer_set_number(metrics, FM_METRIC_PSNR_DB, error->psnr_db);
}

/* The last frame against the baseline's; written only where they differ. */
static fm_status compare_last(run_state *run, fm_error *err)
{
    const size_t bytes = (size_t)run->sequence->width_px * run->sequence->height_px * 4;
    fm_image_error error = { .psnr_db = INFINITY, .ssim = 1 };
    fm_image *ours = NULL, *right = NULL;
    fm_status status = FM_OK;
    uint32_t *pixels = NULL;
    if (memcmp(truth_pixels(&run->truth), tbr_image(run->gpu), bytes) == 0)
        goto out;
    pixels = malloc(bytes);
    if (pixels == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "no memory for an image");
        goto out;
    }
    memcpy(pixels, truth_pixels(&run->truth), bytes);
    status = float_image(&ours, run, tbr_image(run->gpu), err);
    if (status == FM_OK)
        status = float_image(&right, run, pixels, err);
    if (status == FM_OK)
        status = image_compare(&error, ours, right, err);
    if (status == FM_OK && run->job->image[0] != '\0')
        status = image_write(run->job->image, ours, err);
out:
    if (status == FM_OK)
        set_errors(run->metrics, &error);
    image_destroy(ours);
    image_destroy(right);
    free(pixels);
    return status;
}

/* ---- frames ---- */

static energy_result frame_energy(const run_state *run, const tbr_counters *counters,
                                  double all_cycles, double spilled, const model_parameters *p)
{
    const energy_inputs inputs = {
        .counters = counters,
        .cycles = all_cycles,
        .spilled = spilled,
        .has_visibility = (run->parts & FM_PART_VISIBILITY) != 0,
        .has_signatures = (run->parts & FM_PART_SIGNATURES) != 0,
    };
    return energy_of(&inputs, p);
}

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

static void take_frame(run_state *run, uint32_t index)
{
    const tbr_counters *counts = tbr_counts(run->gpu);
    const cycles_frame time = cycles_of_frame(run->cycles, counts);
    const double spilled = cycles_spilled(&run->table.nominal, counts);
    const double all = time.geometry[CYCLES_NOMINAL] + time.raster[CYCLES_NOMINAL];
    const energy_result energy = frame_energy(run, counts, all, spilled, &run->table.nominal);
    const uint64_t wrong = check_frame(run, index);
    run->wrong_tiles += wrong;
    run->wrong_frames += wrong > 0;
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_CYCLES, all);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_ENERGY_NJ, energy.total);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_TILES_SKIPPED,
                      (double)counts->tiles_skipped);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_FRAGMENTS_SHADED,
                      (double)counts->fragments_shaded);
    answer_add_sample(run->samples, index, FM_METRIC_FRAME_WRONG_TILES, (double)wrong);
    if (index == 0)
        return;
    counters_add(&run->sum, counts);
    add_cycles(&run->cycle_sum, &time);
    run->spilled_sum += spilled * (double)(counts->attribute_bytes + counts->list_bytes);
}

static fm_status run_frames(run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    for (uint32_t i = 0; i < run->sequence->frame_count && status == FM_OK; i++) {
        const fm_frame *frame = NULL;
        status = run->sequence->frame(run->sequence, &frame, i, err);
        if (status == FM_OK)
            status = frame_check(frame, i, err);
        const double begin = clock_s();
        if (status == FM_OK)
            status = tbr_frame(run->gpu, frame, err);
        run->seconds +=
            i > 0 ? clock_s() - begin : 0; /* of the frames whose fragments are summed */
        if (status == FM_OK)
            take_frame(run, i);
    }
    return status;
}

/* ---- metrics ---- */

static void set_real(run_state *run, const char *prefix, const char *name, const char *suffix,
                     double value)
{
    char metric[NAME_BYTES];
    snprintf(metric, sizeof metric, "%s%s%s", prefix, name, suffix);
    json_object_set_new(run->metrics, metric, json_real(value));
}

static double all_cycles(const run_state *run)
{
    return run->cycle_sum.geometry[CYCLES_NOMINAL] + run->cycle_sum.raster[CYCLES_NOMINAL];
}

static void set_cycles(run_state *run)
{
    const cycles_frame *sum = &run->cycle_sum;
    answer_set_number(run->metrics, FM_METRIC_CYCLES, all_cycles(run));
    set_real(run, "cycles.", "geometry", "", sum->geometry[CYCLES_NOMINAL]);
    set_real(run, "cycles.", "raster", "", sum->raster[CYCLES_NOMINAL]);
    set_real(run, "cycles.", "raster_b", "", sum->raster_b);
    set_real(run, "cycles.", "signature_stall", "", sum->signature_stall);
    for (size_t i = 0; i < sizeof sum->stages / sizeof sum->stages[0]; i++)
        set_real(run, "cycles.", cycles_stage_names[i], "", sum->stages[i]);
    for (size_t i = CYCLES_NOMINAL + 1; i < CYCLES_VARIANT_COUNT; i++)
        set_real(run, "cycles.", cycles_variants[i].name, "", sum->geometry[i] + sum->raster[i]);
}

static void set_energy(run_state *run)
{
    char name[64];
    const double bytes = (double)(run->sum.attribute_bytes + run->sum.list_bytes);
    const double spilled = bytes > 0 ? run->spilled_sum / bytes : 0;
    const energy_result nominal =
        frame_energy(run, &run->sum, all_cycles(run), spilled, &run->table.nominal);
    answer_set_number(run->metrics, FM_METRIC_ENERGY_NJ, nominal.total);
    for (size_t i = 0; i < ENERGY_COMPONENT_COUNT; i++)
        set_real(run, "energy.", energy_names[i], "_nj", nominal.component[i]);
    for (unsigned i = 0; i < ENERGY_CORNERS; i++) {
        const model_parameters p = energy_corner(name, &run->table, i);
        set_real(run, "energy_corner.", name, "_nj",
                 frame_energy(run, &run->sum, all_cycles(run), spilled, &p).total);
    }
}

static void set_metrics(run_state *run)
{
    for (size_t i = 0; i < TBR_COUNTER_COUNT; i++)
        json_object_set_new(run->metrics, tbr_counter_infos[i].name,
                            json_integer((json_int_t)counters_get(&run->sum, i)));
    answer_set_count(run->metrics, FM_METRIC_FRAGMENTS_GENERATED, run->sum.fragments_rasterised);
    answer_set_count(run->metrics, FM_METRIC_WRONG_TILES, run->wrong_tiles);
    answer_set_count(run->metrics, FM_METRIC_WRONG_FRAMES, run->wrong_frames);
    set_cycles(run);
    set_energy(run);
    const double core_s = run->seconds * tbr_thread_count(run->gpu);
    answer_set_number(run->metrics, FM_METRIC_SIMULATED_RATE,
                      core_s > 0 ? (double)run->sum.fragments_rasterised / core_s : 0);
}

/* What of the simulator ran for this technique and sequence. */
static void set_modelled(json_t *answer, const run_state *run)
{
    static const char *const names[] = { "visibility",   "signatures",  "taint",
                                         "exact ties",   "paper types", "owners",
                                         "prepass",      "final depth", "previous colour",
                                         "object order", "two buffers", "uploads" };
    _Static_assert(FM_PARTS_ALL == (1u << sizeof names / sizeof names[0]) - 1, "one a part");
    json_t *parts = json_array(), *scene = json_array();
    for (unsigned i = 0; i < sizeof names / sizeof names[0]; i++)
        if ((run->parts >> i & 1u) != 0)
            json_array_append_new(parts, json_string(names[i]));
    if (run->sum.layer_lookups > 0)
        json_array_append_new(scene, json_string("layers"));
    answer_set_modelled(answer, scene, parts, json_array());
}

static fm_status finish(json_t *answer, run_state *run, fm_error *err)
{
    const size_t bytes = (size_t)run->sequence->width_px * run->sequence->height_px * 4;
    fm_status status = FM_OK;
    if (run->job->method == NULL) {
        memcpy(truth_pixels(&run->truth), tbr_image(run->gpu), bytes);
        status = text_write_file(run->job->truth, run->truth.bytes, run->truth.count, err);
    } else {
        status = compare_last(run, err);
    }
    if (status != FM_OK)
        return status;
    set_metrics(run);
    answer_set_image_hash(answer, XXH64(tbr_image(run->gpu), bytes, 0));
    answer_set_measured(answer, json_incref(run->metrics), json_incref(run->samples));
    set_modelled(answer, run);
    return FM_OK;
}

static fm_status start(run_state *run, fm_error *err)
{
    const fm_technique_job *job = run->job;
    const fm_method_desc *method = job->method;
    fm_status status = model_table_read(&run->table, job->settings->model, err);
    if (status == FM_OK)
        status = sequence_create(&run->sequence, job->settings, err);
    if (status != FM_OK) /* a scene or a model that cannot be had */
        return status == FM_INVALID || status == FM_IO ? FM_UNSUPPORTED : status;
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
                            .parts = run->parts,
                            .binned = cycles_binned,
                            .rendered = cycles_rendered,
                            .context = run->cycles };
    status = tbr_create(&run->gpu, &desc, err);
    if (status == FM_OK)
        status = method == NULL ? make_truth(run, err) : read_truth(run, err);
    return status;
}

fm_status technique_job_run(json_t *answer, uint64_t *wrong_tiles, const fm_technique_job *job,
                            fm_error *err)
{
    run_state run = { .job = job, .samples = json_array(), .metrics = json_object() };
    fm_status status = start(&run, err);
    if (status == FM_OK)
        status = run_frames(&run, err);
    if (status == FM_OK)
        status = finish(answer, &run, err);
    *wrong_tiles = run.wrong_tiles;
    json_decref(run.samples);
    json_decref(run.metrics);
    free(run.truth.bytes);
    tbr_destroy(run.gpu);
    cycles_destroy(run.cycles);
    sequence_destroy(run.sequence);
    return status;
}
