#include "protocol.h"

#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "code/code_json.h"
#include "model/metrics.h"

enum { REQUEST_MAX_BYTES = 1 << 20 };
static const char truth_job[] = "truth", mesh_job[] = "mesh", device_job[] = "device",
                  measure_job[] = "measure";

static const char *text_in(const json_t *object, const char *field)
{
    const char *text = json_string_value(json_object_get(object, field));
    return text != NULL ? text : "";
}

static bool is_set(const json_t *object, const char *field)
{
    return json_is_true(json_object_get(object, field));
}

/* A text that may hold any bytes: compilers quote sources in any encoding, long texts are cut
 * anywhere, and JSON takes UTF-8 only. */
static json_t *any_text(const char *text)
{
    char *copy = strdup(text);
    if (copy != NULL)
        text_make_utf8(copy);
    json_t *json = json_string(copy != NULL ? copy : "");
    free(copy);
    return json;
}

static json_t *settings_json(const fm_settings *settings)
{
    char value[FM_PATH_MAX_BYTES];
    json_t *object = json_object();
    for (size_t i = 0; i < fm_key_count; i++) {
        settings_text(value, settings, &fm_keys[i]);
        json_object_set_new(object, fm_keys[i].name, json_string(value));
    }
    return object;
}

static json_t *options_json(const fm_request *request)
{
    json_t *object = json_object();
    for (size_t i = 0; i < request->choice_count; i++)
        json_object_set_new(object, request->choices[i].name,
                            json_string(request->choices[i].value));
    return object;
}

static const char *job_of(const fm_request *request)
{
    return request->is_truth_job    ? truth_job
           : request->is_mesh_job   ? mesh_job
           : request->is_device_job ? device_job
                                    : measure_job;
}

/* What is kept, by kept_kind. */
static const char *const keep_fields[] = { "keep_fragments", "keep_truth", "keep_frames" };
_Static_assert(sizeof keep_fields / sizeof keep_fields[0] == KEPT_KIND_COUNT, "one field a kind");

static bool add_keep(json_t *object, const fm_request *request)
{
    bool is_added = object != NULL;
    for (int i = 0; i < KEPT_KIND_COUNT && is_added; i++) {
        const char *path = request->keep[i] != NULL ? request->keep[i] : "";
        is_added = json_object_set_new(object, keep_fields[i], json_string(path)) == 0;
    }
    return is_added;
}

fm_status request_write(const char *path, const fm_request *request, fm_error *err)
{
    json_t *object = json_pack(
        "{s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:s, s:o, s:o, s:s, s:i, s:b, s:s}", "job",
        job_of(request), "plugin", request->plugin, "floor", request->floor, "common",
        request->common, "device", request->device, "validation", (int)request->validation,
        "no_timers", (int)request->no_timers, "feed", request->feed, "settings",
        settings_json(request->settings), "options", options_json(request), "truth", request->truth,
        "launch", (int)request->launch, "check", (int)request->check, "image", request->image);
    const bool is_whole = add_keep(object, request);
    char *text = is_whole ? json_dumps(object, JSON_INDENT(1)) : NULL;
    const fm_status status =
        text != NULL ? text_write_file(path, text, strlen(text), err)
                     : fm_fail(err, FM_INVALID,
                               "%s: not written: no memory, or a path that is not UTF-8", path);
    free(text);
    json_decref(object);
    return status;
}

static fm_status read_settings(fm_read_request *read, fm_error *err)
{
    const char *name;
    json_t *value;
    fm_status status = FM_OK;
    settings_default(&read->settings);
    json_object_foreach(json_object_get(read->json, "settings"), name, value)
    {
        const fm_key *key = key_find(name);
        const char *text = json_string_value(value);
        if (key == NULL || text == NULL)
            return fm_fail(err, FM_INVALID, "request: settings: '%s'", name);
        status = settings_set(&read->settings, key, text, err);
        if (status != FM_OK)
            return status;
    }
    return status;
}

static fm_status read_choices(fm_read_request *read, fm_error *err)
{
    const char *name;
    json_t *value;
    json_object_foreach(json_object_get(read->json, "options"), name, value)
    {
        if (read->request.choice_count == FM_MAX_OPTIONS || !json_is_string(value))
            return fm_fail(err, FM_INVALID, "request: options: '%s'", name);
        fm_choice *choice = &read->choices[read->request.choice_count++];
        if (strlen(name) >= sizeof choice->name ||
            json_string_length(value) >= sizeof choice->value)
            return fm_fail(err, FM_INVALID, "request: options: '%.80s' is too long", name);
        snprintf(choice->name, sizeof choice->name, "%s", name);
        snprintf(choice->value, sizeof choice->value, "%s", json_string_value(value));
    }
    return FM_OK;
}

/* Fields of a request; JSON_TRUE stands for both truth values. */
static const struct {
    const char *name;
    json_type type;
} request_fields[] = {
    { "job", JSON_STRING },
    { "plugin", JSON_STRING },
    { "floor", JSON_STRING },
    { "common", JSON_STRING },
    { "device", JSON_STRING },
    { "validation", JSON_TRUE },
    { "no_timers", JSON_TRUE },
    { "feed", JSON_STRING },
    { "settings", JSON_OBJECT },
    { "options", JSON_OBJECT },
    { "truth", JSON_STRING },
    { "launch", JSON_INTEGER },
    { "check", JSON_TRUE },
    { "image", JSON_STRING },
    { "keep_fragments", JSON_STRING },
    { "keep_truth", JSON_STRING },
    { "keep_frames", JSON_STRING },
};

/* The parent writes all of them; what lacks one was not written by it. */
static fm_status check_request(const json_t *json, const char *path, fm_error *err)
{
    static const char *const jobs[] = { truth_job, mesh_job, device_job, measure_job };
    bool is_job = false;
    for (size_t i = 0; i < sizeof request_fields / sizeof request_fields[0]; i++) {
        const json_t *value = json_object_get(json, request_fields[i].name);
        const json_type type = request_fields[i].type;
        if (value == NULL ||
            (type == JSON_TRUE ? !json_is_boolean(value) : json_typeof(value) != type))
            return fm_fail(err, FM_INVALID, "%s: no request: '%s' is missing or of another kind",
                           path, request_fields[i].name);
    }
    for (size_t i = 0; i < sizeof jobs / sizeof jobs[0]; i++)
        is_job = is_job || strcmp(text_in(json, "job"), jobs[i]) == 0;
    const json_int_t launch = json_integer_value(json_object_get(json, "launch"));
    if (!is_job)
        return fm_fail(err, FM_INVALID, "%s: no request: 'job' is none that is known", path);
    if (launch < 0 || launch > UINT32_MAX)
        return fm_fail(err, FM_INVALID, "%s: no request: 'launch' is %lld", path,
                       (long long)launch);
    return FM_OK;
}

static fm_status load_request(json_t **json, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    json_error_t at;
    fm_status status = text_read_file(&bytes, &count, path, REQUEST_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    *json = json_loadb(bytes != NULL ? bytes : "", count, JSON_REJECT_DUPLICATES, &at);
    free(bytes);
    if (*json == NULL)
        return fm_fail(err, FM_IO, "%s:%d: %s", path, at.line, at.text);
    return FM_OK;
}

fm_status request_read(fm_read_request *read, const char *path, fm_error *err)
{
    *read = (fm_read_request){ .json = NULL };
    read->request = (fm_request){ .settings = &read->settings, .choices = read->choices };
    fm_status status = load_request(&read->json, path, err);
    const json_t *json = read->json;
    if (status == FM_OK)
        status = check_request(json, path, err);
    if (status != FM_OK)
        return status;
    read->request = (fm_request){
        .is_truth_job = strcmp(text_in(json, "job"), truth_job) == 0,
        .is_mesh_job = strcmp(text_in(json, "job"), mesh_job) == 0,
        .is_device_job = strcmp(text_in(json, "job"), device_job) == 0,
        .plugin = text_in(json, "plugin"),
        .floor = text_in(json, "floor"),
        .common = text_in(json, "common"),
        .device = text_in(json, "device"),
        .feed = text_in(json, "feed"),
        .settings = &read->settings,
        .choices = read->choices,
        .truth = text_in(json, "truth"),
        .image = text_in(json, "image"),
        .check = is_set(json, "check"),
        .validation = is_set(json, "validation"),
        .no_timers = is_set(json, "no_timers"),
        .launch = (uint32_t)json_integer_value(json_object_get(json, "launch")),
    };
    for (int i = 0; i < KEPT_KIND_COUNT; i++)
        read->request.keep[i] = text_in(json, keep_fields[i]);
    status = read_settings(read, err);
    return status == FM_OK ? read_choices(read, err) : status;
}

void request_free(fm_read_request *read)
{
    json_decref(read->json);
    *read = (fm_read_request){ 0 };
}

void answer_set_device(json_t *answer, const fm_device_caps *caps)
{
    json_object_set_new(answer, "device_name", any_text(caps->name));
    json_object_set_new(answer, "device_driver", any_text(caps->driver));
    json_object_set_new(answer, "device_api", any_text(caps->api));
    json_object_set_new(answer, "has_gpu_clock", json_boolean(caps->has_gpu_clock));
    json_object_set_new(answer, "is_software", json_boolean(caps->is_software));
}

void answer_set_code(json_t *answer, const fm_code *code)
{
    json_object_set_new(answer, "code", code_to_json(code));
}

void answer_set_verdict(json_t *answer, fm_case_status status, fm_reason reason,
                        const char *message)
{
    json_object_set_new(answer, "status", json_string(case_status_name(status)));
    if (reason != FM_REASON_NONE)
        json_object_set_new(answer, "reason", json_string(case_reason_name(reason)));
    json_object_set_new(answer, "message", any_text(message));
}

void answer_set_runs_fault(json_t *answer, const char *message)
{
    answer_set_verdict(answer, FM_CASE_SKIPPED, FM_REASON_NONE, message);
    json_object_set_new(answer, "is_runs_fault", json_true());
}

void answer_set_truth_unusable(json_t *answer)
{
    json_object_set_new(answer, "is_truth_unusable", json_true());
}

void answer_set_starved(json_t *answer)
{
    json_object_set_new(answer, "is_starved", json_true());
}

void answer_set_image_hashes(json_t *answer, const uint64_t *hashes, size_t count)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, json_sprintf("%016" PRIx64, hashes[i]));
    json_object_set_new(answer, "image_hashes", list);
}

void answer_set_measured(json_t *answer, json_t *metrics, json_t *samples)
{
    json_object_set_new(answer, "metrics", metrics);
    json_object_set_new(answer, "samples", samples);
}

void answer_set_launch(json_t *answer, json_t *launch)
{
    json_object_set_new(answer, "launch", launch);
}

void answer_set_modelled(json_t *answer, json_t *scene, json_t *passes, json_t *buffers)
{
    json_object_set_new(
        answer, "modelled",
        json_pack("{s:o, s:o, s:o}", "scene", scene, "passes", passes, "buffers", buffers));
}

static json_t *point_json(const double point[3])
{
    return json_pack("[f, f, f]", point[0], point[1], point[2]);
}

static json_t *ignored_json(uint32_t ignored)
{
    json_t *names = json_array();
    for (int i = 0; i < FM_MESH_IGNORED_COUNT; i++)
        if ((ignored >> i & 1u) != 0)
            json_array_append_new(names, json_string(mesh_ignored_name((fm_mesh_ignored)i)));
    return names;
}

void answer_set_mesh(json_t *answer, const char *file, const fm_mesh_facts *facts)
{
    fm_text told = { 0 };
    mesh_facts_text(&told, facts);
    json_object_set_new(
        answer, "mesh",
        json_pack("{s:o, s:o, s:s, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:I, s:o, s:o, s:o, s:f}",
                  "file", any_text(file), "told", any_text(told.bytes != NULL ? told.bytes : ""),
                  "format", facts->format, "triangles", (json_int_t)facts->triangles, "vertices",
                  (json_int_t)facts->vertices, "parts", (json_int_t)facts->parts,
                  "faces_without_area", (json_int_t)facts->without_area, "faces_far_from_flat",
                  (json_int_t)facts->warped, "triangles_without_area_as_floats",
                  (json_int_t)facts->lost_area, "lines", (json_int_t)facts->lines, "points",
                  (json_int_t)facts->points, "ignored", ignored_json(facts->ignored), "low",
                  point_json(facts->box.low), "high", point_json(facts->box.high), "spacing",
                  facts->spacing));
    text_free(&told);
}

void answer_add_sample_named(json_t *samples, uint32_t frame, const char *metric, double value)
{
    const fm_metric_info *info = metric_describe(metric);
    json_array_append_new(samples,
                          json_pack("{s:i, s:s, s:f, s:s}", "frame", (int)frame, "metric", metric,
                                    "value", value, "unit", info != NULL ? info->unit : ""));
}

json_t *answer_make(fm_case_status status, fm_reason reason, const char *message)
{
    json_t *answer = json_object();
    if (answer != NULL)
        answer_set_verdict(answer, status, reason, message);
    return answer;
}

json_t *answer_make_runs_fault(const char *message)
{
    json_t *answer = json_object();
    if (answer != NULL)
        answer_set_runs_fault(answer, message);
    return answer;
}

void answer_add_note(json_t *answer, const char *note)
{
    const char *message = answer_message(answer);
    const char *between = message[0] != '\0' ? "; " : "";
    const size_t added = strlen(between) + strlen(note);
    const size_t room = added < FM_MESSAGE_MAX_BYTES ? FM_MESSAGE_MAX_BYTES - added : 0;
    fm_text all = { 0 };
    text_add(&all, "%.*s%s%.*s", (int)room, message, between,
             FM_MESSAGE_MAX_BYTES - (int)strlen(between), note);
    if (!all.failed)
        json_object_set_new(answer, "message", any_text(all.bytes));
    text_free(&all);
}

fm_case_status answer_status(const json_t *answer)
{
    fm_case_status status = FM_CASE_CRASH;
    case_status_parse(&status, json_string_value(json_object_get(answer, "status")));
    return status;
}

fm_reason answer_reason(const json_t *answer)
{
    fm_reason reason = FM_REASON_NONE;
    case_reason_parse(&reason, text_in(answer, "reason"), NULL);
    return reason;
}

bool answer_is_runs_fault(const json_t *answer)
{
    return is_set(answer, "is_runs_fault");
}

bool answer_is_truth_unusable(const json_t *answer)
{
    return is_set(answer, "is_truth_unusable");
}

bool answer_is_starved(const json_t *answer)
{
    return is_set(answer, "is_starved");
}

const char *answer_message(const json_t *answer)
{
    return text_in(answer, "message");
}

bool answer_code(fm_code *code, const json_t *answer)
{
    return code_from_json(code, json_object_get(answer, "code"));
}

json_t *answer_image_hashes(const json_t *answer)
{
    return json_object_get(answer, "image_hashes");
}

json_t *answer_metrics(const json_t *answer)
{
    return json_object_get(answer, "metrics");
}

json_t *answer_modelled(const json_t *answer)
{
    return json_object_get(answer, "modelled");
}

json_t *answer_launch(const json_t *answer)
{
    return json_object_get(answer, "launch");
}

json_t *answer_samples(const json_t *answer)
{
    return json_object_get(answer, "samples");
}

json_t *answer_mesh(const json_t *answer)
{
    return json_object_get(answer, "mesh");
}

const char *answer_mesh_file(const json_t *mesh)
{
    return text_in(mesh, "file");
}

const char *answer_mesh_told(const json_t *mesh)
{
    return text_in(mesh, "told");
}

fm_answer_sample answer_sample(const json_t *sample)
{
    return (fm_answer_sample){
        .frame = (uint32_t)json_integer_value(json_object_get(sample, "frame")),
        .metric = text_in(sample, "metric"),
        .unit = text_in(sample, "unit"),
        .value = json_number_value(json_object_get(sample, "value")),
    };
}

bool answer_device(fm_answer_device *device, const json_t *answer)
{
    const json_t *software = json_object_get(answer, "is_software");
    *device = (fm_answer_device){ .name = text_in(answer, "device_name"),
                                  .driver = text_in(answer, "device_driver"),
                                  .api = text_in(answer, "device_api"),
                                  .has_gpu_clock = is_set(answer, "has_gpu_clock") };
    /* Journals of older runs do not say it. */
    device->is_software = software != NULL ? json_is_true(software) : !device->has_gpu_clock;
    return device->name[0] != '\0';
}
