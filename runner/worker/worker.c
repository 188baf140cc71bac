#include "worker.h"

#include <inttypes.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "answer.h"
#include "device/device.h"
#include "generators/generate.h"
#include "measure.h"
#include "model/feeds.h"
#include "plugin/culling_apply.h"
#include "plugin/plugin.h"
#include "technique_job.h"

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
    job->feed = feed_from_name(name) & (FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES);
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

static bool has_frames(const launch_job *job)
{
    return feed_from_name(text_of(job, "feed")) == FM_FEED_FRAMES;
}

static fm_status open_plugins(launch_job *job)
{
    job->failed_in = "plugin";
    fm_status status = plugin_open(&job->method, text_of(job, "plugin"), &job->error);
    if (status == FM_OK && !has_frames(job))
        status = plugin_open(&job->floor, text_of(job, "floor"), &job->error);
    job->failed_in = NULL;
    return status;
}

static fm_status open_scene(launch_job *job)
{
    fm_status status = settings_finish(&job->settings, &job->error);
    if (status == FM_OK)
        status = scene_create(&job->scene, &job->settings, &job->error);
    if (status == FM_OK && job->feed == FM_FEED_TRIANGLES)
        status = scene_hold(job->scene, &job->error); /* the host rasterises it, too */
    return not_the_plugins(status);
}

/* ---- verdict ---- */

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
    const double allowed = measure_image_tolerance(job->truth->n);
    if (m->self_max_abs <= allowed)
        return false;
    fm_fail(&job->error, FM_OK,
            "declared exact, but the timed image is %.3g from its own fragments (%.2g is allowed)",
            m->self_max_abs, allowed);
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

static fm_status truth_job(launch_job *job)
{
    const char *path = text_of(job, "truth");
    if (has_frames(job))
        return frames_job(job);
    fm_status status = read_feed(job);
    if (status == FM_OK)
        status = open_device(job);
    if (status == FM_OK)
        status = open_scene(job);
    if (status == FM_OK)
        status = truth_capture(path, job->device, job->scene, job->feed, text_of(job, "common"),
                               &job->error);
    if (status == FM_OK)
        status = truth_open(&job->truth, path, &job->error);
    if (status != FM_OK)
        return status;
    answer_add_truth(job->result, job->truth);
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

static fm_status cull(launch_job *job)
{
    const fm_culling_desc desc = { .settings = &job->settings,
                                   .choices = job->choices,
                                   .choice_count = job->choice_count,
                                   .n = job->stage->n,
                                   .feed = job->feed };
    return culling_apply(&job->desc, job->method->method, &desc, &job->error);
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
        status = truth_open(&job->truth, text_of(job, "truth"), &job->error);
    if (status == FM_OK)
        status =
            stage_create(&job->stage, job->device, job->scene, job->truth, job->feed, &job->error);
    if (status == FM_OK)
        status = cull(job);
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
    const fm_answer_desc answer = { .measurement = &job->measurement,
                                    .method = &job->desc,
                                    .settings = &job->settings,
                                    .truth = job->truth,
                                    .stage = job->stage };
    answer_add_measured(job->result, &answer);
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
