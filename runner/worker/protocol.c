#include "protocol.h"

#include <errno.h>
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/text.h"
#include "code/code_json.h"
#include "model/metrics.h"
#include "protocol_json.h"

const char *json_text_in(const json_t *object, const char *field)
{
    const char *text = json_string_value(json_object_get(object, field));
    return text != NULL ? text : "";
}

bool json_is_set(const json_t *object, const char *field)
{
    return json_is_true(json_object_get(object, field));
}

json_t *json_hashes(const uint64_t *hashes, size_t count)
{
    json_t *list = json_array();
    for (size_t i = 0; i < count; i++)
        json_array_append_new(list, json_sprintf("%016" PRIx64, hashes[i]));
    return list;
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

void answer_set_device(json_t *answer, const fm_device_caps *caps)
{
    json_object_set_new(answer, "device_name", any_text(caps->name));
    json_object_set_new(answer, "device_driver", any_text(caps->driver));
    json_object_set_new(answer, "device_api", any_text(caps->api));
    json_object_set_new(answer, "has_gpu_clock", json_boolean(caps->has_gpu_clock));
    json_object_set_new(answer, "is_software", json_boolean(caps->is_software));
    json_object_set_new(answer, "image_layers", json_integer(caps->image_layers));
    json_object_set_new(answer, "image_max_bytes",
                        json_integer(caps->image_max_bytes < INT64_MAX
                                         ? (json_int_t)caps->image_max_bytes
                                         : INT64_MAX));
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
    json_object_set_new(answer, "image_hashes", json_hashes(hashes, count));
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

int answer_write(const json_t *answer, const char *path)
{
    int written = json_dump_file(answer, path, JSON_INDENT(1));
    if (written == 0)
        return 0;
    const int cause = errno;
    char message[FM_PATH_MAX_BYTES + 128];
    unlink(path);
    snprintf(message, sizeof message, "%s: %s", path, strerror(cause));
    json_t *reason = answer_make_runs_fault(message);
    written = json_dump_file(reason, path, 0);
    json_decref(reason);
    return written == 0 ? 0 : WORKER_EXIT_NO_ANSWER;
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
    case_reason_parse(&reason, json_text_in(answer, "reason"), NULL);
    return reason;
}

bool answer_is_runs_fault(const json_t *answer)
{
    return json_is_set(answer, "is_runs_fault");
}

bool answer_is_truth_unusable(const json_t *answer)
{
    return json_is_set(answer, "is_truth_unusable");
}

bool answer_is_starved(const json_t *answer)
{
    return json_is_set(answer, "is_starved");
}

const char *answer_message(const json_t *answer)
{
    return json_text_in(answer, "message");
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
    return json_text_in(mesh, "file");
}

const char *answer_mesh_told(const json_t *mesh)
{
    return json_text_in(mesh, "told");
}

fm_answer_sample answer_sample(const json_t *sample)
{
    return (fm_answer_sample){
        .frame = (uint32_t)json_integer_value(json_object_get(sample, "frame")),
        .metric = json_text_in(sample, "metric"),
        .unit = json_text_in(sample, "unit"),
        .value = json_number_value(json_object_get(sample, "value")),
    };
}

/* 0: there is none, or nonsense. */
static uint64_t count_in(const json_t *answer, const char *name)
{
    const json_int_t count = json_integer_value(json_object_get(answer, name));
    return count > 0 ? (uint64_t)count : 0;
}

bool answer_device(fm_answer_device *device, const json_t *answer)
{
    const json_t *software = json_object_get(answer, "is_software");
    *device = (fm_answer_device){ .name = json_text_in(answer, "device_name"),
                                  .driver = json_text_in(answer, "device_driver"),
                                  .api = json_text_in(answer, "device_api"),
                                  .has_gpu_clock = json_is_set(answer, "has_gpu_clock"),
                                  .image_layers = (uint32_t)count_in(answer, "image_layers"),
                                  .image_max_bytes = count_in(answer, "image_max_bytes") };
    /* Journals of older runs do not say it. */
    device->is_software = software != NULL ? json_is_true(software) : !device->has_gpu_clock;
    return device->name[0] != '\0';
}
