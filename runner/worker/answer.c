#include "answer.h"

#include <inttypes.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "plugin/culling_apply.h"

static void set_number(json_t *object, const char *name, double value)
{
    if (isfinite(value))
        json_object_set_new(object, name, json_real(value));
    else
        json_object_set_new(object, name,
                            json_string(isnan(value) ? "nan"
                                        : value > 0  ? "inf"
                                                     : "-inf"));
}

static void set_count(json_t *object, const char *name, uint64_t value)
{
    json_object_set_new(object, name, json_integer((json_int_t)value));
}

static void add_sample(json_t *samples, uint32_t frame, const char *metric, double value,
                       const char *unit)
{
    json_array_append_new(samples, json_pack("{s:i, s:s, s:f, s:s}", "frame", (int)frame, "metric",
                                             metric, "value", value, "unit", unit));
}

static bool is_standard_pass(const char *name)
{
    static const char *const standard[] = { "clear", "count", "reference", "store", "resolve" };
    for (size_t i = 0; i < sizeof standard / sizeof standard[0]; i++)
        if (strcmp(standard[i], name) == 0)
            return true;
    return false;
}

static void add_passes(json_t *samples, uint32_t frame, const fm_sample *sample,
                       const fm_method_desc *method)
{
    uint64_t map = 0;
    char metric[96];
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++) {
        const char *name = method->passes[i].name;
        snprintf(metric, sizeof metric, "%s%s_ms", is_standard_pass(name) ? "" : "pass.", name);
        add_sample(samples, frame, metric, (double)sample->pass_ns[i] * 1e-6, "ms");
        map += culling_is_map_pass(&method->passes[i]) ? sample->pass_ns[i] : 0;
    }
    if (culling_is_applied(method))
        add_sample(samples, frame, "culling_ms", (double)map * 1e-6, "ms");
}

static void add_frame(json_t *samples, uint32_t frame, const fm_sample *sample,
                      const fm_answer_desc *of)
{
    const bool has_passes = of->settings->timers == FM_TIMERS_PASSES;
    if (has_passes)
        add_passes(samples, frame, sample, of->method);
    add_sample(samples, frame, "frame_ms", (double)sample->frame_ns * 1e-6, "ms");
    add_sample(samples, frame, "frame_wall_ms", (double)sample->wall_ns * 1e-6, "ms");
    if (has_passes)
        add_sample(samples, frame, "floor_store_ms", (double)sample->floor_store_ns * 1e-6, "ms");
    add_sample(samples, frame, "floor_frame_ms", (double)sample->floor_frame_ns * 1e-6, "ms");
    add_sample(samples, frame, "canary_ns", (double)sample->canary_ns, "ns");
}

/* What the k nearest ask for is F_k; what is beyond them may be left out: of it how much was, by
 * the map or by the method's own test, and how many fragments the method took for each that it
 * keeps. */
static void add_culled(json_t *metrics, const fm_answer_desc *of)
{
    const fm_measurement *m = of->measurement;
    const double all = (double)of->truth->fragment_count;
    const double taken = (double)m->arrived - (double)m->culled;
    const double kept = (double)truth_kept(of->truth, measure_places(of->method, of->settings->k));
    if (culling_is_applied(of->method))
        set_count(metrics, "cull_words", of->settings->cull_words);
    if ((of->stage->feed & FM_FEEDS_FRAGMENTS) == 0) /* no fragments arrive, so none are counted */
        return;
    set_count(metrics, "fragments_arrived", m->arrived);
    set_count(metrics, "fragments_culled", m->culled);
    set_count(metrics, "locks_taken", m->locked);
    if (of->method->keeps != FM_KEEPS_K_NEAREST)
        return;
    if (all > kept)
        set_number(metrics, "discarded_share", (all - taken) / (all - kept));
    if (kept > 0)
        set_number(metrics, "taken_per_kept", taken / kept);
}

static void add_checked(json_t *metrics, const fm_measurement *m, const fm_truth *truth)
{
    set_count(metrics, "fragments_stored", m->check.captured);
    set_count(metrics, "missing", m->check.missing);
    set_count(metrics, "extra", m->check.extra);
    set_count(metrics, "misordered", m->check.misordered);
    set_count(metrics, "depth_ulp_max", m->check.depth_ulp_max);
    set_count(metrics, "wrong_pixels", m->check.wrong_pixels);
    set_count(metrics, "nonempty_pixels", truth->nonempty_pixels);
    set_number(metrics, "self_max_abs", m->self_max_abs);
    set_number(metrics, "rmse", m->error.rmse);
    set_number(metrics, "psnr_db", m->error.psnr_db);
    set_number(metrics, "max_abs", m->error.max_abs);
    set_number(metrics, "ssim", m->error.ssim);
    set_number(metrics, "truncation_rmse", m->truncation_rmse);
    set_number(metrics, "total_rmse", m->total_rmse);
}

static void add_metrics(json_t *result, const fm_answer_desc *of)
{
    const fm_measurement *m = of->measurement;
    json_t *metrics = json_object(), *samples = json_array();
    char hash[17];
    set_count(metrics, "n", of->stage->n);
    set_count(metrics, "bytes_allocated", m->bytes_allocated);
    set_count(metrics, "bytes_predicted", m->bytes_predicted);
    set_count(metrics, "bytes_used", m->bytes_used);
    set_count(metrics, "fragments_generated", of->truth->fragment_count);
    set_count(metrics, "fragments_lost", m->lost);
    set_count(metrics, "frames_redone", m->frames_redone);
    set_number(metrics, "redone_ms", (double)m->redone_ns * 1e-6);
    set_count(metrics, "frames_lossy", m->frames_lossy);
    set_count(metrics, "scene_passes", m->scene_passes);
    if (m->k_chosen > 0)
        set_count(metrics, "k_chosen", m->k_chosen);
    if (m->is_checked) {
        add_checked(metrics, m, of->truth);
        add_culled(metrics, of);
    }
    for (uint32_t i = 0; i < m->sample_count; i++)
        add_frame(samples, i, &m->samples[i], of);
    snprintf(hash, sizeof hash, "%016" PRIx64, image_hash(m->image));
    json_object_set_new(result, "image_hash", json_string(hash));
    json_object_set_new(result, "metrics", metrics);
    json_object_set_new(result, "samples", samples);
}

/* What was allocated and run for this scene, and so what was not. */
static void add_modelled(json_t *result, const fm_answer_desc *of)
{
    json_t *scene = json_array(), *passes = json_array(), *buffers = json_array();
    for (int i = 0; i < STAGE_SLOT_COUNT; i++)
        if (of->stage->slots[i].buffer != NULL)
            json_array_append_new(scene, json_string(of->stage->slots[i].name));
    if (of->stage->vertices != NULL)
        json_array_append_new(scene, json_string("vertices"));
    for (size_t i = 0; i < FM_MAX_PASSES && of->method->passes[i].name != NULL; i++)
        json_array_append_new(passes, json_string(of->method->passes[i].name));
    for (size_t i = 0; i < FM_MAX_RESOURCES && of->method->resources[i].name != NULL; i++)
        json_array_append_new(buffers, json_string(of->method->resources[i].name));
    json_object_set_new(
        result, "modelled",
        json_pack("{s:o, s:o, s:o}", "scene", scene, "passes", passes, "buffers", buffers));
}

void answer_add_measured(json_t *result, const fm_answer_desc *of)
{
    add_metrics(result, of);
    add_modelled(result, of);
}

void answer_add_truth(json_t *result, const fm_truth *truth)
{
    json_t *metrics = json_object();
    set_count(metrics, "n", truth->n);
    set_count(metrics, "fragments_generated", truth->fragment_count);
    set_count(metrics, "nonempty_pixels", truth->nonempty_pixels);
    json_object_set_new(result, "metrics", metrics);
}
