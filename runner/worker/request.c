#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "protocol_json.h"

/* A known image takes 22 bytes: most of them leave 320 KiB for paths and settings. */
enum { REQUEST_MAX_BYTES = 1 << 20, REQUEST_KNOWN_MOST = 1 << 15 };
static const char truth_job[] = "truth", mesh_job[] = "mesh", device_job[] = "device",
                  measure_job[] = "measure";

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
    const size_t known = request->known_count < REQUEST_KNOWN_MOST ? request->known_count
                                                                   : (size_t)REQUEST_KNOWN_MOST;
    json_t *object = json_pack(
        "{s:i, s:s, s:s, s:s, s:s, s:s, s:b, s:b, s:s, s:o, s:o, s:s, s:i, s:b, s:s, s:s, s:o}",
        "protocol", FM_PROTOCOL, "job", job_of(request), "plugin", request->plugin, "floor",
        request->floor, "common", request->common, "device", request->device, "validation",
        (int)request->validation, "no_timers", (int)request->no_timers, "feed", request->feed,
        "settings", settings_json(request->settings), "options", options_json(request), "truth",
        request->truth, "launch", (int)request->launch, "check", (int)request->check, "image",
        request->image, "range", request->range != NULL ? request->range : "", "known_images",
        json_hashes(request->known_images, known));
    const bool is_whole =
        add_keep(object, request) &&
        json_object_set_new(object, "cache",
                            json_string(request->cache != NULL ? request->cache : "")) == 0;
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

static fm_status read_known_images(fm_read_request *read, fm_error *err)
{
    const json_t *list = json_object_get(read->json, "known_images");
    const size_t count = json_array_size(list);
    read->known_images = calloc(count + 1, sizeof read->known_images[0]);
    if (read->known_images == NULL)
        return fm_fail(err, FM_NO_MEMORY, "request: %zu known images", count);
    for (size_t i = 0; i < count; i++) {
        const char *digits = json_string_value(json_array_get(list, i));
        if (digits == NULL || strlen(digits) != 16 || strspn(digits, "0123456789abcdef") != 16)
            return fm_fail(err, FM_INVALID, "request: known_images: not hashes of 16 digits");
        read->known_images[i] = strtoull(digits, NULL, 16);
    }
    read->request.known_images = read->known_images;
    read->request.known_count = count;
    return FM_OK;
}

/* Fields of a request; JSON_TRUE stands for both truth values. */
static const struct {
    const char *name;
    json_type type;
} request_fields[] = {
    { "job", JSON_STRING },         { "plugin", JSON_STRING },
    { "floor", JSON_STRING },       { "common", JSON_STRING },
    { "device", JSON_STRING },      { "validation", JSON_TRUE },
    { "no_timers", JSON_TRUE },     { "feed", JSON_STRING },
    { "settings", JSON_OBJECT },    { "options", JSON_OBJECT },
    { "truth", JSON_STRING },       { "cache", JSON_STRING },
    { "launch", JSON_INTEGER },     { "check", JSON_TRUE },
    { "image", JSON_STRING },       { "range", JSON_STRING },
    { "known_images", JSON_ARRAY }, { "keep_fragments", JSON_STRING },
    { "keep_truth", JSON_STRING },  { "keep_frames", JSON_STRING },
};

/* The parent writes all of them; what lacks one was not written by it. */
static fm_status check_request(const json_t *json, const char *path, fm_error *err)
{
    static const char *const jobs[] = { truth_job, mesh_job, device_job, measure_job };
    bool is_job = false;
    const json_t *protocol = json_object_get(json, "protocol");
    if (!json_is_integer(protocol) || json_integer_value(protocol) != FM_PROTOCOL)
        return fm_fail(err, FM_INVALID, "%s: no request of protocol %d, which this program speaks",
                       path, FM_PROTOCOL);
    for (size_t i = 0; i < sizeof request_fields / sizeof request_fields[0]; i++) {
        const json_t *value = json_object_get(json, request_fields[i].name);
        const json_type type = request_fields[i].type;
        if (value == NULL ||
            (type == JSON_TRUE ? !json_is_boolean(value) : json_typeof(value) != type))
            return fm_fail(err, FM_INVALID, "%s: no request: '%s' is missing or of another kind",
                           path, request_fields[i].name);
    }
    for (size_t i = 0; i < sizeof jobs / sizeof jobs[0]; i++)
        is_job = is_job || strcmp(json_text_in(json, "job"), jobs[i]) == 0;
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
        .is_truth_job = strcmp(json_text_in(json, "job"), truth_job) == 0,
        .is_mesh_job = strcmp(json_text_in(json, "job"), mesh_job) == 0,
        .is_device_job = strcmp(json_text_in(json, "job"), device_job) == 0,
        .plugin = json_text_in(json, "plugin"),
        .floor = json_text_in(json, "floor"),
        .common = json_text_in(json, "common"),
        .device = json_text_in(json, "device"),
        .feed = json_text_in(json, "feed"),
        .settings = &read->settings,
        .choices = read->choices,
        .truth = json_text_in(json, "truth"),
        .cache = json_text_in(json, "cache"),
        .image = json_text_in(json, "image"),
        .range = json_text_in(json, "range"),
        .check = json_is_set(json, "check"),
        .validation = json_is_set(json, "validation"),
        .no_timers = json_is_set(json, "no_timers"),
        .launch = (uint32_t)json_integer_value(json_object_get(json, "launch")),
    };
    for (int i = 0; i < KEPT_KIND_COUNT; i++)
        read->request.keep[i] = json_text_in(json, keep_fields[i]);
    status = read_settings(read, err);
    if (status == FM_OK)
        status = read_known_images(read, err);
    return status == FM_OK ? read_choices(read, err) : status;
}

void request_free(fm_read_request *read)
{
    json_decref(read->json);
    free(read->known_images);
    *read = (fm_read_request){ 0 };
}
