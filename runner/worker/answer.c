#include "answer.h"

#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>

#include "plugin/culling_apply.h"
#include "protocol.h"

void answer_set_number(json_t *metrics, fm_metric metric, double value)
{
    const char *name = fm_metrics[metric].name;
    if (isfinite(value))
        json_object_set_new(metrics, name, json_real(value));
    else
        json_object_set_new(metrics, name,
                            json_string(isnan(value) ? "nan"
                                        : value > 0  ? "inf"
                                                     : "-inf"));
}

void answer_set_count(json_t *metrics, fm_metric metric, uint64_t value)
{
    json_object_set_new(metrics, fm_metrics[metric].name, json_integer((json_int_t)value));
}

void answer_add_sample(json_t *samples, uint32_t frame, fm_metric metric, double value)
{
    answer_add_sample_named(samples, frame, fm_metrics[metric].name, value);
}

/* Passes of the standard names have metrics of their own, the others are of a family. */
static void add_pass(json_t *samples, uint32_t frame, const char *name, double ms)
{
    static const struct {
        const char *name;
        fm_metric metric;
    } standard[] = { { "clear", FM_METRIC_CLEAR_MS },
                     { "count", FM_METRIC_COUNT_MS },
                     { "reference", FM_METRIC_REFERENCE_MS },
                     { "store", FM_METRIC_STORE_MS },
                     { "resolve", FM_METRIC_RESOLVE_MS } };
    char own[96];
    for (size_t i = 0; i < sizeof standard / sizeof standard[0]; i++) {
        if (strcmp(standard[i].name, name) == 0) {
            answer_add_sample(samples, frame, standard[i].metric, ms);
            return;
        }
    }
    snprintf(own, sizeof own, "pass.%s_ms", name);
    answer_add_sample_named(samples, frame, own, ms);
}

static void add_passes(json_t *samples, uint32_t frame, const fm_sample *sample,
                       const fm_method_desc *method)
{
    uint64_t map = 0;
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++) {
        const char *name = method->passes[i].name;
        add_pass(samples, frame, name, (double)sample->pass_ns[i] * 1e-6);
        map += culling_is_map_pass(&method->passes[i]) ? sample->pass_ns[i] : 0;
    }
    if (culling_is_applied(method))
        answer_add_sample(samples, frame, FM_METRIC_CULLING_MS, (double)map * 1e-6);
}

static void add_frame(json_t *samples, uint32_t frame, const fm_sample *sample,
                      const fm_answer_desc *desc)
{
    const bool has_passes = desc->settings->timers == FM_TIMERS_PASSES;
    if (has_passes)
        add_passes(samples, frame, sample, desc->method);
    answer_add_sample(samples, frame, FM_METRIC_FRAME_MS, (double)sample->frame_ns * 1e-6);
    answer_add_sample(samples, frame, FM_METRIC_FRAME_WALL_MS, (double)sample->wall_ns * 1e-6);
    answer_add_sample(samples, frame, FM_METRIC_FRAME_CPU_MS, (double)sample->cpu_ns * 1e-6);
    if (has_passes)
        answer_add_sample(samples, frame, FM_METRIC_FLOOR_STORE_MS,
                          (double)sample->floor_store_ns * 1e-6);
    answer_add_sample(samples, frame, FM_METRIC_FLOOR_FRAME_MS,
                      (double)sample->floor_frame_ns * 1e-6);
    answer_add_sample(samples, frame, FM_METRIC_CANARY_NS, (double)sample->canary_ns);
}

/* What the k nearest ask for is F_k; what is beyond them may be left out: of it how much was, by
 * the map or by the method's own test, and how many fragments the method took for each that it
 * keeps. */
static void add_culled(json_t *metrics, const fm_answer_desc *desc)
{
    const fm_measurement *m = desc->measurement;
    const double all = (double)desc->truth->fragment_count;
    /* Only the raster feed counts what arrives: the others hand over all that there is. */
    const uint64_t arrived =
        desc->stage->feed == FM_FEED_RASTER ? m->arrived : desc->truth->fragment_count;
    const double taken = (double)arrived - (double)m->culled;
    const double kept =
        (double)truth_kept(desc->truth, measure_places(desc->method, desc->settings->k));
    if (culling_is_applied(desc->method))
        answer_set_count(metrics, FM_METRIC_CULL_WORDS, desc->settings->cull_words);
    if ((desc->stage->feed & FM_FEEDS_FRAGMENTS) ==
        0) /* no fragments arrive, so none are counted */
        return;
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_ARRIVED, arrived);
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_CULLED, m->culled);
    answer_set_count(metrics, FM_METRIC_LOCKS_TAKEN, m->locked);
    if ((desc->method->traits & FM_TRAIT_RACY) != 0) {
        answer_set_count(metrics, FM_METRIC_PIXELS_REPAIRED, m->repaired);
        answer_set_count(metrics, FM_METRIC_PIXELS_UNREPAIRED, m->unrepaired);
    }
    if (desc->method->keeps != FM_KEEPS_K_NEAREST)
        return;
    if (all > kept)
        answer_set_number(metrics, FM_METRIC_DISCARDED_SHARE, (all - taken) / (all - kept));
    if (kept > 0)
        answer_set_number(metrics, FM_METRIC_TAKEN_PER_KEPT, taken / kept);
}

typedef struct error_row {
    fm_metric metric;
    fm_region region;
    size_t offset; /* of the number in fm_region_error */
} error_row;

#define VIEWPORT(id, member)                                                                       \
    {                                                                                              \
        FM_METRIC_##id, FM_REGION_VIEWPORT, offsetof(fm_region_error, member)                      \
    }
#define COVERED(id, member)                                                                        \
    {                                                                                              \
        FM_METRIC_COVERED_##id, FM_REGION_COVERED, offsetof(fm_region_error, member)               \
    }
/* clang-format off */
static const error_row own_rows[] = {
    VIEWPORT(RMSE, difference.rmse),       COVERED(RMSE, difference.rmse),
    VIEWPORT(PSNR_DB, difference.psnr_db), COVERED(PSNR_DB, difference.psnr_db),
    VIEWPORT(MAX_ABS, difference.max_abs), COVERED(MAX_ABS, difference.max_abs),
    VIEWPORT(SSIM, ssim),                  COVERED(SSIM, ssim),
    VIEWPORT(FLIP, flip.mean),             COVERED(FLIP, flip.mean),
    VIEWPORT(FLIP_MEDIAN, flip.weighted_median), COVERED(FLIP_MEDIAN, flip.weighted_median),
    VIEWPORT(FLIP_P95, flip.p95),          COVERED(FLIP_P95, flip.p95),
    VIEWPORT(FLIP_MAX, flip.max),          COVERED(FLIP_MAX, flip.max),
};
static const error_row total_rows[] = {
    VIEWPORT(TOTAL_RMSE, difference.rmse), VIEWPORT(TOTAL_MAX_ABS, difference.max_abs),
    VIEWPORT(TOTAL_SSIM, ssim),            VIEWPORT(TOTAL_FLIP, flip.mean),
};
/* clang-format on */

/* What does not apply, as ssim of an image that is smaller than a window, stays empty. */
static void add_rows(json_t *metrics, const fm_image_error *error, const error_row *rows,
                     size_t count)
{
    for (size_t i = 0; i < count; i++) {
        const char *region = (const char *)&error->region[rows[i].region];
        const double value = *(const double *)(const void *)(region + rows[i].offset);
        if (!isnan(value))
            answer_set_number(metrics, rows[i].metric, value);
    }
}

static void add_errors(json_t *metrics, const fm_image_error *own, const fm_image_error *total)
{
    add_rows(metrics, own, own_rows, sizeof own_rows / sizeof own_rows[0]);
    add_rows(metrics, total, total_rows, sizeof total_rows / sizeof total_rows[0]);
}

static void add_losses(json_t *metrics, const fm_check *check)
{
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_WANTED, check->wanted);
    answer_set_count(metrics, FM_METRIC_DECLARED_TIES, check->declared.of_ties);
    answer_set_count(metrics, FM_METRIC_DECLARED_AT_ONE, check->declared.at_depth_one);
    answer_set_count(metrics, FM_METRIC_LOST_TIES, check->excused.of_ties);
    answer_set_count(metrics, FM_METRIC_LOST_AT_ONE, check->excused.at_depth_one);
}

static void add_checked(json_t *metrics, const fm_measurement *m, const fm_truth *truth)
{
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_STORED, m->check.captured);
    answer_set_count(metrics, FM_METRIC_MISSING, m->check.missing);
    answer_set_count(metrics, FM_METRIC_EXTRA, m->check.extra);
    answer_set_count(metrics, FM_METRIC_MISORDERED, m->check.misordered);
    answer_set_count(metrics, FM_METRIC_DEPTH_ULP_MAX, m->check.depth_ulp_max);
    answer_set_count(metrics, FM_METRIC_WRONG_PIXELS, m->check.wrong_pixels);
    add_losses(metrics, &m->check);
    answer_set_count(metrics, FM_METRIC_NONEMPTY_PIXELS, truth->nonempty_pixels);
    answer_set_count(metrics, FM_METRIC_TRUTH_DIGEST, truth_digest(truth));
    answer_set_count(metrics, FM_METRIC_TIED_PIXELS, m->tied_pixels);
    answer_set_number(metrics, FM_METRIC_SELF_MAX_ABS, m->self_max_abs);
    answer_set_number(metrics, FM_METRIC_SELF_BEYOND, m->self_beyond);
    if (m->check.captured > 0) /* an approximation hands none over */
        answer_set_number(metrics, FM_METRIC_IMAGE_ULP_MAX, m->image_ulp_max);
    if (m->check.captured > 0)
        answer_set_count(metrics, FM_METRIC_DISTINCT_FRAGMENTS, m->distinct_fragments);
    answer_set_count(metrics, FM_METRIC_CAPTURED_FRAMES, m->captured_frames);
    answer_set_count(metrics, FM_METRIC_MISSING_MAX, m->missing_max);
    add_errors(metrics, &m->error, &m->total_error);
    answer_set_number(metrics, FM_METRIC_TRUNCATION_RMSE, m->truncation_rmse);
}

/* Empty where nothing was counted. */
static void add_accesses(json_t *metrics, const fm_measurement *m)
{
    char name[96];
    const fm_accesses all = measure_accesses(m);
    if (m->accesses_count == 0)
        return;
    answer_set_count(metrics, FM_METRIC_BYTES_MOVED, all.loaded + all.stored);
    answer_set_count(metrics, FM_METRIC_ATOMICS, all.atomics);
    answer_set_count(metrics, FM_METRIC_ACCESSES_OUTSIDE, all.outside);
    for (size_t i = 0; i < m->accesses_count; i++) {
        const fm_accesses *counts = &m->accesses[i].counts;
        snprintf(name, sizeof name, "moved.%s_b", m->accesses[i].name);
        if (counts->loaded + counts->stored > 0)
            json_object_set_new(metrics, name,
                                json_integer((json_int_t)(counts->loaded + counts->stored)));
    }
}

static void add_metrics(json_t *answer, const fm_answer_desc *desc)
{
    const fm_measurement *m = desc->measurement;
    json_t *metrics = json_object(), *samples = json_array();
    answer_set_count(metrics, FM_METRIC_N, desc->stage->n);
    answer_set_count(metrics, FM_METRIC_BYTES_ALLOCATED, m->bytes_allocated);
    answer_set_count(metrics, FM_METRIC_BYTES_PREDICTED, m->bytes_predicted);
    answer_set_count(metrics, FM_METRIC_BYTES_USED, m->bytes_used);
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_GENERATED, desc->truth->fragment_count);
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_LOST, m->lost);
    answer_set_count(metrics, FM_METRIC_FRAMES_REDONE, m->frames_redone);
    answer_set_number(metrics, FM_METRIC_REDONE_MS, (double)m->redone_ns * 1e-6);
    answer_set_count(metrics, FM_METRIC_FRAMES_LOSSY, m->frames_lossy);
    answer_set_count(metrics, FM_METRIC_SCENE_PASSES, m->scene_passes);
    if (m->k_chosen > 0)
        answer_set_count(metrics, FM_METRIC_K_CHOSEN, m->k_chosen);
    if (m->is_checked) {
        add_checked(metrics, m, desc->truth);
        add_culled(metrics, desc);
        add_accesses(metrics, m);
    }
    for (uint32_t i = 0; i < m->sample_count; i++)
        add_frame(samples, i, &m->samples[i], desc);
    answer_set_image_hashes(answer, m->image_hashes, m->distinct_images);
    answer_set_measured(answer, metrics, samples);
}

/* What was allocated and run for this scene, and so what was not. */
static void add_modelled(json_t *answer, const fm_answer_desc *desc)
{
    json_t *scene = json_array(), *passes = json_array(), *buffers = json_array();
    for (int i = 0; i < STAGE_SLOT_COUNT; i++)
        if (desc->stage->slots[i].buffer != NULL)
            json_array_append_new(scene, json_string(desc->stage->slots[i].name));
    if (desc->stage->vertices != NULL)
        json_array_append_new(scene, json_string("vertices"));
    for (size_t i = 0; i < FM_MAX_PASSES && desc->method->passes[i].name != NULL; i++)
        json_array_append_new(passes, json_string(desc->method->passes[i].name));
    for (size_t i = 0; i < FM_MAX_RESOURCES && desc->method->resources[i].name != NULL; i++)
        json_array_append_new(buffers, json_string(desc->method->resources[i].name));
    answer_set_modelled(answer, scene, passes, buffers);
}

void answer_add_measured(json_t *answer, const fm_answer_desc *desc)
{
    add_metrics(answer, desc);
    add_modelled(answer, desc);
}

static void add_known(json_t *launch, fm_metric metric, double value)
{
    if (isfinite(value))
        answer_set_number(launch, metric, value);
}

static void add_timed_part(json_t *launch, const fm_host_load *begin, const fm_host_load *end)
{
    const double own_s = end->own_cpu_s - begin->own_cpu_s;
    const double machine_s = end->machine_cpu_s - begin->machine_cpu_s;
    add_known(launch, FM_METRIC_TIMED_S, end->clock_s - begin->clock_s);
    add_known(launch, FM_METRIC_TIMED_CPU_S, own_s);
    add_known(launch, FM_METRIC_WAITED_S, end->waited_s - begin->waited_s);
    if (!isnan(machine_s)) /* its clock is coarse, and may lag behind the process's */
        add_known(launch, FM_METRIC_OTHERS_CPU_S, fmax(machine_s - own_s, 0.0));
    add_known(launch, FM_METRIC_INVOLUNTARY_SWITCHES,
              end->involuntary_switches - begin->involuntary_switches);
    add_known(launch, FM_METRIC_LOAD_BEGIN, begin->load);
    add_known(launch, FM_METRIC_LOAD_END, end->load);
    add_known(launch, FM_METRIC_THROTTLED_S, end->throttled_s - begin->throttled_s);
    add_known(launch, FM_METRIC_THERMAL_EVENTS, end->thermal_count - begin->thermal_count);
    add_known(launch, FM_METRIC_CLOCK_SHARE, end->clock_share);
}

static const char *const part_names[PART_COUNT] = {
    [PART_START] = "start",   [PART_SCENE] = "scene",   [PART_COMPILE] = "compile",
    [PART_WARMUP] = "warmup", [PART_FRAMES] = "frames", [PART_FLOOR] = "floor",
    [PART_IMAGES] = "images", [PART_CHECK] = "check",   [PART_ERRORS] = "errors",
    [PART_END] = "end",
};

/* Of a launch that measured: parts of others are of no use. */
static void add_parts(json_t *launch, launch_parts *parts)
{
    char name[64];
    for (int part = 0; part < PART_COUNT; part++) {
        snprintf(name, sizeof name, "launch.%s_ms", part_names[part]);
        json_object_set_new(launch, name, json_real(part_ms(parts, (launch_part)part)));
    }
}

void answer_add_launch(json_t *answer, const fm_measurement *m, launch_parts *parts)
{
    json_t *launch = json_object();
    add_known(launch, FM_METRIC_LAUNCH_CPU_S, host_load_own_cpu_s());
    if (m->sample_count > 0)
        add_timed_part(launch, &m->begin, &m->end);
    if (m->sample_count > 0)
        add_parts(launch, parts);
    if (m->has_new_images) {
        answer_set_number(launch, FM_METRIC_FRAMES_RMSE_MAX, m->frames_worst.rmse);
        answer_set_number(launch, FM_METRIC_FRAMES_MAX_ABS, m->frames_worst.max_abs);
        answer_set_number(launch, FM_METRIC_FRAMES_TOTAL_RMSE_MAX, m->frames_worst.total_rmse);
    }
    answer_set_launch(answer, launch);
}

void answer_add_truth(json_t *answer, const fm_truth *truth)
{
    json_t *metrics = json_object();
    answer_set_count(metrics, FM_METRIC_N, truth->n);
    answer_set_count(metrics, FM_METRIC_FRAGMENTS_GENERATED, truth->fragment_count);
    answer_set_count(metrics, FM_METRIC_NONEMPTY_PIXELS, truth->nonempty_pixels);
    answer_set_measured(answer, metrics, json_array());
}
