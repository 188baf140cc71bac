#include "worker.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "answer.h"
#include "capture/truth_capture.h"
#include "capture/truth_kept.h"
#include "device/library.h"
#include "generators/generate.h"
#include "image/image_files.h"
#include "measure.h"
#include "model/feeds.h"
#include "plugin/culling_apply.h"
#include "plugin/plugin.h"
#include "process/open_files.h"
#include "protocol.h"
#include "technique_job.h"
#include "verdict.h"

/* Everything a launch holds. */
typedef struct launch_job {
    const fm_device_list *devices;
    fm_read_request read;
    const fm_request *request; /* in `read` */
    json_t *answer;
    fm_device *device;
    fm_plugin *method, *floor;
    const char *mark_path;
    fm_hook_mark *mark;                /* what of the plugin is running; NULL: it cannot be told */
    fm_choice choices[FM_MAX_OPTIONS]; /* all of the method's options, nothing left open */
    size_t choice_count;
    fm_method_desc desc;  /* the method, with culling if that is asked for */
    fm_settings settings; /* finished */
    uint32_t feed;
    fm_scene *scene;
    fm_truth *truth;
    fm_stage *stage;
    char hull[FM_PATH_MAX_BYTES + 8]; /* beside the truth, for later launches of the scene */
    fm_measurement measurement;
    launch_parts parts;
    fm_cache cache;
    fm_technique_outcome sequence; /* of a technique */
    fm_code code;                  /* what was loaded and read */
    fm_error error;
    bool has_request; /* it was read and understood */
    bool is_plugins;  /* the plugin is at work: what fails now is its fault */
    bool is_opening;  /* it is being opened: whatever the status, it is refused */
    bool is_truths;   /* the truth file is read */
    bool is_devices;  /* the device cannot be opened, which says nothing of what it supports */
    bool is_floors;   /* the floor, which fragmark brings, is opened */
    bool is_leaking;  /* the plugin left so many files open that there may be no more */
} launch_job;

static fm_status read_feed(launch_job *job)
{
    const char *name = job->request->feed;
    job->feed = feed_from_name(name) & (FM_FEEDS_FRAGMENTS | FM_FEED_TRIANGLES);
    if (job->feed == 0)
        return fm_refuse(&job->error, FM_REASON_FEED,
                         "feed '%s' is not one that this device carries", name);
    return FM_OK;
}

/* A scene that cannot be had is nothing that a plugin did wrong. */
static fm_status refuse_scene(launch_job *job, fm_status status)
{
    return fm_error_refuse(&job->error, status, FM_REASON_SCENE);
}

static fm_status open_device(launch_job *job)
{
    const fm_device_desc desc = { .validation = job->request->validation,
                                  .no_timers = job->request->no_timers,
                                  .cache = &job->cache };
    fm_status status =
        device_open(&job->device, job->devices, job->request->device, &desc, &job->error);
    job->is_devices = status != FM_OK && status != FM_UNSUPPORTED;
    if (status != FM_OK)
        return status;
    answer_set_device(job->answer, &job->device->caps);
    job->code.driver = device_build_hash(&job->device->caps, job->code.program);
    return FM_OK;
}

static bool has_frames(const launch_job *job)
{
    return feed_from_name(job->request->feed) == FM_FEED_FRAMES;
}

static fm_status open_plugins(launch_job *job)
{
    job->is_opening = true;
    job->mark = hook_mark_open(job->mark_path, job->request->plugin);
    code_add_plugin(&job->code, FM_CODE_OF_METHOD, job->request->plugin);
    hook_enter(job->mark, FM_HOOK_LOAD);
    fm_status status =
        plugin_open(&job->method, job->request->plugin, job->request->common, &job->error);
    hook_leave(job->mark, FM_HOOK_LOAD);
    job->is_opening = status != FM_OK;
    if (status != FM_OK || has_frames(job))
        return status;
    code_add_plugin(&job->code, FM_CODE_OF_FLOOR, job->request->floor);
    status = plugin_open(&job->floor, job->request->floor, job->request->common, &job->error);
    job->is_floors = status != FM_OK;
    return status;
}

static fm_status open_scene(launch_job *job)
{
    fm_status status = settings_finish(&job->settings, &job->error);
    if (status == FM_OK)
        status = scene_create(&job->scene, &job->settings, &job->error);
    if (status == FM_OK && job->scene->facts.format[0] != '\0' &&
        (job->request->is_truth_job || job->request->is_mesh_job || job->request->check))
        answer_set_mesh(job->answer, job->settings.mesh, &job->scene->facts);
    if (status == FM_OK && job->feed == FM_FEED_TRIANGLES)
        status = scene_hold(job->scene, &job->error); /* the host rasterises it, too */
    return refuse_scene(job, status);
}

static bool is_bad_input(fm_status status)
{
    return status == FM_IO || status == FM_INVALID || status == FM_SHADER;
}

/* What the run itself writes and reads, its requests, and what fragmark brings: GLSL of the runner
 * and the floor; and a device that cannot be opened. Disks fill, somebody deletes, an installation
 * breaks; no method did anything wrong. */
static bool is_runs_fault(const launch_job *job, fm_status status)
{
    if (status == FM_OK)
        return false;
    if (!job->has_request || job->is_floors || job->is_devices)
        return true;
    if (job->is_leaking && strstr(job->error.message, strerror(EMFILE)) != NULL)
        return false;
    if ((status == FM_IO || job->is_opening) && fm_error_is_the_worlds(&job->error))
        return true;
    if (job->measurement.is_floors)
        return is_bad_input(status);
    return status == FM_IO && (job->error.is_own || (!job->is_opening && !job->is_plugins));
}

/* What a failure says of the case. The runner's own shaders, which a device refuses, and scenes
 * that cannot be had are nothing that a method did wrong. */
static fm_case_status verdict(const launch_job *job, fm_status status)
{
    const bool is_plugins = job->is_opening || job->is_plugins || job->is_leaking;
    if (status != FM_OK && job->is_opening)
        return FM_CASE_PLUGIN_ERROR;
    switch (status) {
    case FM_OK:
        return FM_CASE_OK;
    case FM_UNSUPPORTED:
        return FM_CASE_NOT_SUPPORTED;
    case FM_NO_MEMORY:
        return FM_CASE_OUT_OF_MEMORY;
    case FM_DEVICE_LOST:
        return FM_CASE_DEVICE_LOST;
    case FM_INVALID:
    case FM_IO:
    case FM_SHADER:
    case FM_STATUS_COUNT:
        break;
    }
    return is_plugins ? FM_CASE_PLUGIN_ERROR : FM_CASE_NOT_SUPPORTED;
}

/* Of a case that is not supported. A failure that verdict takes for no fault is one of the driver's
 * compiler, with the runner's own shaders, or of the scene. */
static fm_reason reason_of(const launch_job *job, fm_case_status word, fm_status status)
{
    if (word != FM_CASE_NOT_SUPPORTED)
        return FM_REASON_NONE;
    if (status == FM_UNSUPPORTED)
        return job->error.reason;
    return status == FM_SHADER ? FM_REASON_DRIVER : FM_REASON_SCENE;
}

/* What is to be known of a result beside its numbers; notes stand one after the other. */
__attribute__((format(printf, 2, 3))) static void note(launch_job *job, const char *format, ...)
{
    char *message = job->error.message;
    const size_t room = sizeof job->error.message, length = strlen(message);
    const int separator = snprintf(message + length, room - length, length > 0 ? "; " : "");
    const size_t begin = length + (size_t)separator;
    va_list values;
    if (begin >= room)
        return;
    va_start(values, format);
    vsnprintf(message + begin, room - begin, format, values);
    va_end(values);
}

/* Frames: the simulated GPU runs the whole sequence; a truth job has no method, the baseline. */
static fm_status frames_job(launch_job *job)
{
    const fm_technique_job desc = {
        .method = job->method != NULL ? job->method->method : NULL,
        .settings = &job->settings,
        .choices = job->request->choices,
        .choice_count = job->request->choice_count,
        .mark = job->mark,
        .truth = job->request->truth,
        .image = job->request->image,
        .keep = job->request->keep[KEPT_FRAMES],
    };
    fm_status status = open_device(job);
    if (status == FM_OK)
        status = refuse_scene(job, settings_finish(&job->settings, &job->error));
    if (status == FM_OK)
        status = technique_job_run(job->answer, &job->sequence, &desc, &job->error);
    job->is_truths = status == FM_IO && job->method != NULL;
    job->is_plugins = job->sequence.is_techniques;
    if (status == FM_OK && job->sequence.fragments == 0)
        note(job, "%s", FM_NOTHING_DRAWN);
    return status;
}

/* What was captured before is what would be captured; who continues the run compares all GLSL. */
static fm_status capture(launch_job *job, const char *path)
{
    const char *common = job->request->common;
    const fm_shader_folders folders = { .method = common, .common = common, .code = &job->code };
    const truth_origin origin = { .settings = &job->settings,
                                  .feed = job->request->feed,
                                  .caps = &job->device->caps,
                                  .driver = job->code.driver,
                                  .common = common };
    fm_code glsl = { 0 };
    fm_status status = FM_OK;
    const cache_key key = truth_key(&glsl, &job->cache, &origin);
    if (cache_read_file(path, &job->cache, CACHE_TRUTH, &key)) {
        code_join(&job->code, &glsl);
    } else {
        status = open_scene(job);
        if (status == FM_OK)
            status = truth_capture(path, job->device, job->scene, job->feed, &folders, &job->error);
        if (status == FM_OK && !glsl.failed)
            cache_write_file(&job->cache, CACHE_TRUTH, &key, path);
    }
    code_free(&glsl);
    return status;
}

static fm_status truth_job(launch_job *job)
{
    const char *path = job->request->truth;
    fm_status status = refuse_scene(job, settings_finish(&job->settings, &job->error));
    if (status != FM_OK)
        return status;
    settings_for_truth(&job->settings, &job->settings);
    if (has_frames(job))
        return frames_job(job);
    status = read_feed(job);
    if (status == FM_OK)
        status = open_device(job);
    if (status == FM_OK)
        status = capture(job, path);
    if (status == FM_OK)
        status = truth_open(&job->truth, path, &job->error);
    if (status != FM_OK)
        return status;
    answer_add_truth(job->answer, job->truth);
    return FM_OK;
}

static fm_status measure(launch_job *job)
{
    const char *common = job->request->common;
    const uint32_t places = measure_places(&job->desc, job->settings.k);
    const fm_instance_desc method = {
        .stage = job->stage,
        .method = &job->desc,
        .folders = { .method = job->method->folder, .common = common, .code = &job->code },
        .settings = &job->settings,
        .choices = job->choices,
        .choice_count = job->choice_count,
        .fragments = job->truth->fragment_count,
        .fragments_kept = truth_kept(job->truth, places),
        .mark = job->mark,
    };
    fm_instance_desc floor = method;
    floor.method = job->floor->method;
    floor.folders.method = job->floor->folder;
    floor.folders.owner = FM_CODE_OF_FLOOR;
    floor.choice_count = 0;
    floor.mark = NULL;
    const fm_measure_desc desc = { .method = &method,
                                   .floor = &floor,
                                   .truth = job->truth,
                                   .frames = job->settings.frames,
                                   .warmup = job->settings.warmup,
                                   .check = job->request->check,
                                   .known_images = job->request->known_images,
                                   .known_count = job->request->known_count,
                                   .parts = &job->parts,
                                   .keep = job->request->keep[KEPT_FRAGMENTS] };
    return measure_case(&job->measurement, &desc, &job->error);
}

static fm_status cull(launch_job *job)
{
    const fm_instance_desc asked = { .stage = job->stage,
                                     .method = job->method->method,
                                     .settings = &job->settings,
                                     .choices = job->request->choices,
                                     .choice_count = job->request->choice_count };
    job->choice_count = instance_choices(job->choices, &asked);
    const fm_culling_desc desc = { .settings = &job->settings,
                                   .choices = job->choices,
                                   .choice_count = job->choice_count,
                                   .n = job->stage->n,
                                   .feed = job->feed };
    return culling_apply(&job->desc, job->method->method, &desc, &job->error);
}

/* What the plugin itself is at work in. */
static fm_status run_method(launch_job *job)
{
    job->is_plugins = true;
    fm_status status = cull(job);
    if (status == FM_OK)
        status = measure(job);
    job->is_plugins = status != FM_OK;
    return status;
}

static fm_status open_truth(launch_job *job)
{
    job->is_truths = true;
    fm_status status = truth_open(&job->truth, job->request->truth, &job->error);
    if (status == FM_OK && (job->truth->width_px != job->scene->width_px ||
                            job->truth->height_px != job->scene->height_px))
        status = fm_fail(&job->error, FM_IO, "%s: the truth of another scene: damaged",
                         job->request->truth);
    job->is_truths = status != FM_OK;
    return status;
}

static void add_notes(launch_job *job)
{
    char accesses[VERDICT_ACCESSES_BYTES];
    if (job->truth->fragment_count == 0)
        note(job, "%s", FM_NOTHING_DRAWN);
    if (verdict_accesses(accesses, &job->measurement))
        note(job, "%s", accesses);
    if (job->measurement.is_long)
        note(job, "frames over 2 s: %u samples a launch, the interval is wide",
             job->measurement.sample_count);
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
    parts_enter(&job->parts, PART_SCENE);
    if (status == FM_OK)
        status = open_scene(job);
    if (status == FM_OK)
        status = open_truth(job);
    if (status == FM_OK)
        status =
            stage_create(&job->stage, job->device, job->scene, job->truth, job->feed, &job->error);
    if (status == FM_OK) {
        snprintf(job->hull, sizeof job->hull, "%s.hull", job->request->truth);
        job->stage->hull_cache = job->hull;
        status = run_method(job);
    }
    parts_enter(&job->parts, PART_END);
    if (status == FM_OK)
        status = truth_keep(job->request->keep[KEPT_TRUTH], job->request->truth, job->truth,
                            &job->error);
    if (status == FM_OK)
        status = image_files_write(job->request->image, job->measurement.image,
                                   job->measurement.truth_image, &job->error);
    if (status == FM_OK)
        status = image_range_write(job->request->range, &job->measurement.range, &job->error);
    if (status != FM_OK)
        return status;
    add_notes(job);
    const fm_answer_desc answer = { .measurement = &job->measurement,
                                    .method = &job->desc,
                                    .settings = &job->settings,
                                    .truth = job->truth,
                                    .stage = job->stage };
    answer_add_measured(job->answer, &answer);
    return FM_OK;
}

/* A result's message tells what the validation found, unless there is worse to tell. */
static void note_validation(launch_job *job, fm_case_status word)
{
    const char *first = "";
    if (job->device == NULL || !job->request->validation || word != FM_CASE_OK)
        return;
    const uint32_t count = job->device->ops->validation_errors(job->device, &first);
    if (count > 0)
        note(job, "validation: %u errors, the first: %s", count, first);
}

static void release(launch_job *job)
{
    measurement_free(&job->measurement);
    stage_destroy(job->stage);
    truth_close(job->truth);
    scene_destroy(job->scene);
    device_close(job->device);
    cache_close(&job->cache);
    plugin_close(job->floor);
    plugin_close(job->method);
    hook_mark_close(job->mark);
    request_free(&job->read);
    code_free(&job->code);
    json_decref(job->answer);
}

static bool is_wrong(launch_job *job)
{
    const uint32_t traits = job->method->method->traits;
    if (has_frames(job))
        return verdict_frames_are_wrong(&job->error, &job->sequence, traits);
    return verdict_is_wrong(&job->error, &job->measurement, traits, job->truth->n);
}

/* wrong_image, if the method finished and its image is wrong. */
static fm_case_status case_status_of(launch_job *job, fm_status status)
{
    char loss[VERDICT_LOSS_BYTES];
    if (status != FM_OK || job->method == NULL)
        return verdict(job, status);
    const bool wrong = is_wrong(job);
    if (verdict_loss(loss, &job->measurement.check))
        note(job, "%s", loss);
    return wrong ? FM_CASE_WRONG_IMAGE : FM_CASE_OK;
}

/* A lock that gave up on a software rasteriser is perhaps the machine's doing. */
static void note_starved(launch_job *job, fm_case_status word)
{
    if (!job->measurement.gave_up || (word != FM_CASE_WRONG_IMAGE && word != FM_CASE_NOT_SUPPORTED))
        return;
    note(job, "a lock gave up in all tries of a frame, as it may where the machine is busy");
    answer_set_starved(job->answer);
}

static void note_left_open(launch_job *job, uint32_t count)
{
    job->is_leaking = job->method != NULL && count > 0;
    if (job->is_leaking)
        note(job, "%s left %u files open", job->method->method->id, count);
}

int worker_main(const char *request_path, const char *answer_path, const fm_device_list *devices)
{
    char mark_path[FM_PATH_MAX_BYTES];
    snprintf(mark_path, sizeof mark_path, WORKER_HOOK_FILE, answer_path);
    launch_job job = { .devices = devices, .answer = json_object(), .mark_path = mark_path };
    fm_open_files files;
    parts_begin(&job.parts);
    open_files_begin(&files);
    job.request = &job.read.request;
    fm_status status = request_read(&job.read, request_path, &job.error);
    job.has_request = status == FM_OK;
    job.settings = job.read.settings;
    job.code.program = code_hash_file("/proc/self/exe");
    if (status == FM_OK)
        cache_open(&job.cache, job.request->cache, job.code.program);
    if (status == FM_OK)
        status = job.request->is_mesh_job     ? open_scene(&job)
                 : job.request->is_device_job ? open_device(&job)
                 : job.request->is_truth_job  ? truth_job(&job)
                                              : measure_job(&job);
    note_left_open(&job, open_files_left(&files));
    const fm_case_status word = case_status_of(&job, status);
    note_validation(&job, word);
    note_starved(&job, word);
    if (is_runs_fault(&job, status)) {
        answer_set_runs_fault(job.answer, job.error.message);
        if (job.is_truths)
            answer_set_truth_unusable(job.answer);
    } else {
        answer_set_verdict(job.answer, word, reason_of(&job, word, status), job.error.message);
    }
    answer_set_code(job.answer, &job.code);
    if (!job.request->is_truth_job)
        answer_add_launch(job.answer, &job.measurement, &job.parts);
    const int code = answer_write(job.answer, answer_path);
    release(&job);
    return code;
}
