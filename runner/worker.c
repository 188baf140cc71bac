#include "worker.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "culling.h"
#include "device/device.h"
#include "measure.h"
#include "plugin.h"
#include "technique_job.h"

/* Largest difference of a timed image from its own captured fragments composited in double. */
#define SELF_MAX_ABS 1e-6

/* Everything a launch holds. */
typedef struct launch_job {
    json_t *request, *result;
    fm_device *device;
    fm_plugin *method, *floor;
    fm_method_desc desc; /* the method, with culling if that is asked for */
    fm_settings settings;
    fm_choice choices[FM_MAX_OPTIONS];
    size_t choice_count;
    uint32_t feed;
    fm_scene *scene;
    fm_truth *truth;
    fm_stage *stage;
    char hull[FM_PATH_MAX_BYTES + 8]; /* beside the truth, for later launches of the scene */
    fm_measurement measurement;
    uint64_t wrong_tiles; /* of a technique */
    fm_error error;
    const char *failed_in; /* "plugin": a failure is the plugin's fault */
} launch_job;

/* ---- request ---- */

static const char *text_of(const launch_job *job, const char *key)
{
    const char *text = json_string_value(json_object_get(job->request, key));
    return text != NULL ? text : "";
}

static bool is_set(const launch_job *job, const char *key)
{
    return json_is_true(json_object_get(job->request, key));
}

static fm_status read_settings(launch_job *job)
{
    const char *name;
    json_t *value;
    fm_status status = FM_OK;
    settings_default(&job->settings);
    json_object_foreach(json_object_get(job->request, "settings"), name, value)
    {
        const fm_key *key = key_find(name);
        const char *text = json_string_value(value);
        if (key == NULL || text == NULL)
            return fm_fail(&job->error, FM_INVALID, "request: settings: '%s'", name);
        status = settings_set(&job->settings, key, text, &job->error);
        if (status != FM_OK)
            return status;
    }
    json_object_foreach(json_object_get(job->request, "options"), name, value)
    {
        if (job->choice_count == FM_MAX_OPTIONS || !json_is_string(value))
            return fm_fail(&job->error, FM_INVALID, "request: options: '%s'", name);
        fm_choice *choice = &job->choices[job->choice_count++];
        snprintf(choice->name, sizeof choice->name, "%s", name);
        snprintf(choice->value, sizeof choice->value, "%s", json_string_value(value));
    }
    return status;
}

static fm_status read_feed(launch_job *job)
{
    const char *name = text_of(job, "feed");
    job->feed = feed_from_name(name) & FM_FEEDS_FRAGMENTS;
    if (job->feed == 0)
        return fm_fail(&job->error, FM_UNSUPPORTED, "feed '%s' is not one that this device carries",
                       name);
    return FM_OK;
}

/* No such device, or a mesh that cannot be used, is nothing that a plugin did wrong. */
static fm_status not_the_plugins(fm_status status)
{
    return status == FM_INVALID || status == FM_IO ? FM_UNSUPPORTED : status;
}

static fm_status open_device(launch_job *job)
{
    const fm_device_desc desc = { .validation = is_set(job, "validation"),
                                  .no_timers = is_set(job, "no_timers") };
    fm_status status = device_open(&job->device, text_of(job, "device"), &desc, &job->error);
    if (status != FM_OK)
        return not_the_plugins(status);
    const fm_device_caps *caps = &job->device->caps;
    json_object_set_new(job->result, "device_name", json_string(caps->name));
    json_object_set_new(job->result, "device_driver", json_string(caps->driver));
    json_object_set_new(job->result, "device_api", json_string(caps->api));
    json_object_set_new(job->result, "has_gpu_clock", json_boolean(caps->has_gpu_clock));
    json_object_set_new(job->result, "is_software", json_boolean(caps->is_software));
    return FM_OK;
}

static fm_status open_plugins(launch_job *job)
{
    job->failed_in = "plugin";
    fm_status status = plugin_open(&job->method, text_of(job, "plugin"), &job->error);
    if (status == FM_OK)
        status = plugin_open(&job->floor, text_of(job, "floor"), &job->error);
    job->failed_in = NULL;
    return status;
}

static fm_status open_scene(launch_job *job)
{
    fm_status status = settings_finish(&job->settings, &job->error);
    if (status == FM_OK)
        status = scene_create(&job->scene, &job->settings, &job->error);
    return not_the_plugins(status);
}

/* ---- result ---- */

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

static void add_frame(json_t *samples, uint32_t frame, const fm_sample *sample,
                      const fm_method_desc *method)
{
    uint64_t sum = 0, map = 0;
    char metric[96];
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++) {
        const char *name = method->passes[i].name;
        snprintf(metric, sizeof metric, "%s%s_ms", is_standard_pass(name) ? "" : "pass.", name);
        add_sample(samples, frame, metric, (double)sample->pass_ns[i] * 1e-6, "ms");
        sum += sample->pass_ns[i];
        map += culling_is_map_pass(&method->passes[i]) ? sample->pass_ns[i] : 0;
    }
    if (culling_is_applied(method))
        add_sample(samples, frame, "culling_ms", (double)map * 1e-6, "ms");
    add_sample(samples, frame, "frame_ms", (double)sum * 1e-6, "ms");
    add_sample(samples, frame, "frame_wall_ms", (double)sample->wall_ns * 1e-6, "ms");
    add_sample(samples, frame, "floor_store_ms", (double)sample->floor_store_ns * 1e-6, "ms");
    add_sample(samples, frame, "floor_frame_ms", (double)sample->floor_frame_ns * 1e-6, "ms");
    add_sample(samples, frame, "canary_ns", (double)sample->canary_ns, "ns");
}

/* What the k nearest ask for is F_k; what is beyond them may be left out: of it how much was, by
 * the map or by the method's own test, and how many fragments the method took for each that it
 * keeps. */
static void add_culled(json_t *metrics, const launch_job *job)
{
    const fm_measurement *m = &job->measurement;
    const double all = (double)job->truth->fragment_count;
    const double taken = (double)m->arrived - (double)m->culled;
    const double kept = (double)truth_kept(job->truth, measure_places(&job->desc, job->settings.k));
    if (culling_is_applied(&job->desc))
        set_count(metrics, "cull_words", job->settings.cull_words);
    if (job->desc.keeps != FM_KEEPS_K_NEAREST)
        return;
    if (all > kept)
        set_number(metrics, "discarded_share", (all - taken) / (all - kept));
    if (kept > 0)
        set_number(metrics, "taken_per_kept", taken / kept);
}

static void add_checked(json_t *metrics, const fm_measurement *m, const fm_truth *truth)
{
    set_count(metrics, "fragments_stored", m->check.captured);
    set_count(metrics, "fragments_arrived", m->arrived);
    set_count(metrics, "fragments_culled", m->culled);
    set_count(metrics, "locks_taken", m->locked);
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

static void add_metrics(launch_job *job)
{
    const fm_measurement *m = &job->measurement;
    json_t *metrics = json_object(), *samples = json_array();
    char hash[17];
    set_count(metrics, "n", job->stage->n);
    set_count(metrics, "bytes_allocated", m->bytes_allocated);
    set_count(metrics, "bytes_predicted", m->bytes_predicted);
    set_count(metrics, "bytes_used", m->bytes_used);
    set_count(metrics, "fragments_generated", job->truth->fragment_count);
    set_count(metrics, "fragments_lost", m->lost);
    set_count(metrics, "frames_redone", m->frames_redone);
    set_number(metrics, "redone_ms", (double)m->redone_ns * 1e-6);
    set_count(metrics, "frames_lossy", m->frames_lossy);
    set_count(metrics, "scene_passes", m->scene_passes);
    if (m->k_chosen > 0)
        set_count(metrics, "k_chosen", m->k_chosen);
    if (m->is_checked) {
        add_checked(metrics, m, job->truth);
        add_culled(metrics, job);
    }
    for (uint32_t i = 0; i < m->sample_count; i++)
        add_frame(samples, i, &m->samples[i], &job->desc);
    snprintf(hash, sizeof hash, "%016" PRIx64, image_hash(m->image));
    json_object_set_new(job->result, "image_hash", json_string(hash));
    json_object_set_new(job->result, "metrics", metrics);
    json_object_set_new(job->result, "samples", samples);
}

/* What was allocated and run for this scene, and so what was not. */
static void add_modelled(launch_job *job)
{
    json_t *scene = json_array(), *passes = json_array(), *buffers = json_array();
    for (int i = 0; i < STAGE_SLOT_COUNT; i++)
        if (job->stage->slots[i].buffer != NULL)
            json_array_append_new(scene, json_string(job->stage->slots[i].name));
    if (job->stage->vertices != NULL)
        json_array_append_new(scene, json_string("vertices"));
    for (size_t i = 0; i < FM_MAX_PASSES && job->desc.passes[i].name != NULL; i++)
        json_array_append_new(passes, json_string(job->desc.passes[i].name));
    for (size_t i = 0; i < FM_MAX_RESOURCES && job->desc.resources[i].name != NULL; i++)
        json_array_append_new(buffers, json_string(job->desc.resources[i].name));
    json_object_set_new(
        job->result, "modelled",
        json_pack("{s:o, s:o, s:o}", "scene", scene, "passes", passes, "buffers", buffers));
}

static const char *status_word(const launch_job *job, fm_status status)
{
    if (status != FM_OK && job->failed_in != NULL)
        return "plugin_error";
    switch (status) {
    case FM_OK:
        return "ok";
    case FM_UNSUPPORTED:
        return "not_supported";
    case FM_NO_MEMORY:
        return "out_of_memory";
    case FM_DEVICE_LOST:
        return "device_lost";
    case FM_INVALID:
    case FM_IO:
    case FM_SHADER:
    case FM_STATUS_COUNT:
        break;
    }
    return "plugin_error";
}

/* An exact method is judged; of others wrong images are data. */
static bool is_wrong(launch_job *job)
{
    const fm_measurement *m = &job->measurement;
    if (job->method == NULL)
        return false;
    if (job->wrong_tiles > 0 && (job->method->method->traits & FM_TRAIT_EXACT) != 0) {
        fm_fail(&job->error, FM_OK, "declared exact, but %" PRIu64 " tiles are not the baseline's",
                job->wrong_tiles);
        return true;
    }
    if (!m->is_checked || (job->desc.traits & FM_TRAIT_EXACT) == 0)
        return false;
    if (m->check.missing + m->check.extra + m->check.misordered + m->lost > 0) {
        fm_fail(&job->error, FM_OK,
                "declared exact, but missing %" PRIu64 ", extra %" PRIu64 ", misordered %" PRIu64
                ", lost %" PRIu64 " fragments in %" PRIu64 " pixels",
                m->check.missing, m->check.extra, m->check.misordered, m->lost,
                m->check.wrong_pixels);
        return true;
    }
    if (m->self_max_abs <= SELF_MAX_ABS)
        return false;
    fm_fail(&job->error, FM_OK,
            "declared exact, but the timed image is %.3g from its own fragments (%.0e is allowed)",
            m->self_max_abs, SELF_MAX_ABS);
    return true;
}

/* ---- jobs ---- */

/* Frames: the simulated GPU runs the whole sequence; a truth job has no method, the baseline. */
static fm_status frames_job(launch_job *job)
{
    const fm_technique_job desc = {
        .method = job->method != NULL ? job->method->method : NULL,
        .settings = &job->settings,
        .choices = job->choices,
        .choice_count = job->choice_count,
        .truth = text_of(job, "truth"),
        .image = text_of(job, "image"),
    };
    fm_status status = open_device(job);
    if (status == FM_OK)
        status = not_the_plugins(settings_finish(&job->settings, &job->error));
    if (status == FM_OK)
        status =
            not_the_plugins(technique_job_run(job->result, &job->wrong_tiles, &desc, &job->error));
    return status;
}

static bool has_frames(const launch_job *job)
{
    return feed_from_name(text_of(job, "feed")) == FM_FEED_FRAMES;
}

static fm_status truth_job(launch_job *job)
{
    const char *path = text_of(job, "truth");
    if (has_frames(job))
        return frames_job(job);
    fm_status status = open_device(job);
    if (status == FM_OK)
        status = open_scene(job);
    if (status == FM_OK)
        status = truth_capture(path, job->device, job->scene, text_of(job, "common"), &job->error);
    if (status == FM_OK)
        status = truth_open(&job->truth, path, &job->error);
    if (status != FM_OK)
        return status;
    json_t *metrics = json_object();
    set_count(metrics, "n", job->truth->n);
    set_count(metrics, "fragments_generated", job->truth->fragment_count);
    set_count(metrics, "nonempty_pixels", job->truth->nonempty_pixels);
    json_object_set_new(job->result, "metrics", metrics);
    return FM_OK;
}

static fm_status write_images(launch_job *job)
{
    const char *path = text_of(job, "image");
    char truth_path[FM_PATH_MAX_BYTES];
    static const char suffix[] = ".rgba32f";
    const size_t length = strlen(path);
    if (length == 0)
        return FM_OK;
    if (length < sizeof suffix || length + sizeof ".truth" > sizeof truth_path)
        return fm_fail(&job->error, FM_INVALID, "request: image: '%s'", path);
    snprintf(truth_path, sizeof truth_path, "%.*s.truth%s", (int)(length - sizeof suffix + 1), path,
             suffix);
    fm_status status = image_write(path, job->measurement.image, &job->error);
    if (status == FM_OK && job->measurement.truth_image != NULL)
        status = image_write(truth_path, job->measurement.truth_image, &job->error);
    return status;
}

static fm_status measure(launch_job *job)
{
    const char *common = text_of(job, "common");
    const uint32_t places = measure_places(&job->desc, job->settings.k);
    const fm_instance_desc method = {
        .stage = job->stage,
        .method = &job->desc,
        .folders = { job->method->folder, common },
        .settings = &job->settings,
        .choices = job->choices,
        .choice_count = job->choice_count,
        .fragments = job->truth->fragment_count,
        .fragments_kept = truth_kept(job->truth, places),
    };
    fm_instance_desc floor = method;
    floor.method = job->floor->method;
    floor.folders.method = job->floor->folder;
    floor.choice_count = 0;
    const fm_measure_desc desc = { .method = &method,
                                   .floor = &floor,
                                   .truth = job->truth,
                                   .frames = job->settings.frames,
                                   .warmup = job->settings.warmup,
                                   .check = is_set(job, "check") };
    return measure_case(&job->measurement, &desc, &job->error);
}

static fm_status measure_job(launch_job *job)
{
    fm_status status = open_plugins(job);
    if (status == FM_OK && has_frames(job))
        return frames_job(job);
    if (status == FM_OK)
        status = read_feed(job);
    if (status == FM_OK)
        status = open_device(job);
    if (status == FM_OK)
        status = open_scene(job);
    if (status == FM_OK)
        status =
            culling_apply(&job->desc, job->method->method, &job->settings, job->feed, &job->error);
    if (status == FM_OK)
        status = truth_open(&job->truth, text_of(job, "truth"), &job->error);
    if (status == FM_OK)
        status =
            stage_create(&job->stage, job->device, job->scene, job->truth, job->feed, &job->error);
    if (status == FM_OK) {
        snprintf(job->hull, sizeof job->hull, "%s.hull", text_of(job, "truth"));
        job->stage->hull_cache = job->hull;
        status = measure(job);
    }
    if (status == FM_OK)
        status = write_images(job);
    if (status != FM_OK)
        return status;
    if (job->measurement.is_long)
        fm_fail(&job->error, FM_OK, "frames over 2 s: %u samples a launch, the interval is wide",
                job->measurement.sample_count);
    add_metrics(job);
    add_modelled(job);
    return FM_OK;
}

/* A result's message tells what the validation found, unless there is worse to tell. */
static void note_validation(launch_job *job)
{
    const char *first = "";
    if (job->device == NULL || !is_set(job, "validation"))
        return;
    const uint32_t count = job->device->ops->validation_errors(job->device, &first);
    if (count > 0 && job->error.message[0] == '\0')
        fm_fail(&job->error, FM_OK, "validation: %u errors, the first: %s", count, first);
}

/* Compilers quote sources in any encoding, and long texts are cut anywhere: JSON takes UTF-8 only.
 */
static json_t *message_json(fm_error *error)
{
    json_t *message = json_string(error->message);
    for (char *c = error->message; message == NULL && *c != '\0'; c++)
        if ((unsigned char)*c > '~')
            *c = '?';
    return message != NULL ? message : json_string(error->message);
}

static void release(launch_job *job)
{
    measurement_free(&job->measurement);
    stage_destroy(job->stage);
    truth_close(job->truth);
    scene_destroy(job->scene);
    device_close(job->device);
    plugin_close(job->floor);
    plugin_close(job->method);
    json_decref(job->request);
    json_decref(job->result);
}

int worker_main(const char *request_path, const char *result_path)
{
    launch_job job = { .result = json_object() };
    json_error_t at;
    job.request = json_load_file(request_path, 0, &at);
    fm_status status = FM_OK;
    if (job.request == NULL)
        status = fm_fail(&job.error, FM_IO, "%s:%d: %s", request_path, at.line, at.text);
    if (status == FM_OK)
        status = read_settings(&job);
    if (status == FM_OK)
        status = strcmp(text_of(&job, "job"), "truth") == 0 ? truth_job(&job) : measure_job(&job);
    const char *word =
        status == FM_OK && is_wrong(&job) ? "wrong_image" : status_word(&job, status);
    json_object_set_new(job.result, "status", json_string(word));
    note_validation(&job);
    json_object_set_new(job.result, "message", message_json(&job.error));
    const int written = json_dump_file(job.result, result_path, JSON_INDENT(1));
    release(&job);
    return written == 0 ? 0 : 1;
}
