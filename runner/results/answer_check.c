#include "answer_check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "model/metrics.h"
#include "simulator/counters.h"
#include "worker/protocol.h"

enum {
    NAME_BYTES = 127,   /* of a metric, a pass, a buffer */
    DEVICE_BYTES = 127, /* what fm_device_caps holds */
    LIST_LENGTH = 4096,
    HASH_DIGITS = 16,
};

typedef struct field_rule {
    const char *name;
    json_type type;
    size_t most_bytes; /* of a text */
} field_rule;

/* The name of the field stands in protocol.h; JSON_TRUE stands for both truth values. */
static const field_rule answer_fields[] = {
    { "status", JSON_STRING, NAME_BYTES },
    { "message", JSON_STRING, FM_MESSAGE_MAX_BYTES },
    { "reason", JSON_STRING, NAME_BYTES },
    { "is_runs_fault", JSON_TRUE, 0 },
    { "is_truth_unusable", JSON_TRUE, 0 },
    { "is_starved", JSON_TRUE, 0 },
    { "code", JSON_OBJECT, 0 },
    { "device_name", JSON_STRING, DEVICE_BYTES },
    { "device_driver", JSON_STRING, DEVICE_BYTES },
    { "device_api", JSON_STRING, DEVICE_BYTES },
    { "has_gpu_clock", JSON_TRUE, 0 },
    { "is_software", JSON_TRUE, 0 },
    { "image_layers", JSON_INTEGER, 0 },
    { "image_max_bytes", JSON_INTEGER, 0 },
    { "modelled", JSON_OBJECT, 0 },
    { "image_hashes", JSON_ARRAY, 0 },
    { "mesh", JSON_OBJECT, 0 },
    { "metrics", JSON_OBJECT, 0 },
    { "launch", JSON_OBJECT, 0 },
    { "samples", JSON_ARRAY, 0 },
};
static const field_rule modelled_fields[] = {
    { "scene", JSON_ARRAY, 0 },
    { "passes", JSON_ARRAY, 0 },
    { "buffers", JSON_ARRAY, 0 },
};
static const field_rule mesh_fields[] = {
    { "file", JSON_STRING, FM_PATH_MAX_BYTES - 1 },
    { "told", JSON_STRING, FM_MESSAGE_MAX_BYTES },
    { "format", JSON_STRING, NAME_BYTES },
    { "ignored", JSON_ARRAY, 0 },
    { "low", JSON_ARRAY, 0 },
    { "high", JSON_ARRAY, 0 },
};
#define COUNT_OF(rules) (sizeof(rules) / sizeof(rules)[0])

static const char *type_words(json_type type)
{
    return type == JSON_STRING    ? "a text"
           : type == JSON_OBJECT  ? "an object"
           : type == JSON_ARRAY   ? "a list"
           : type == JSON_INTEGER ? "a whole number"
                                  : "true or false";
}

/* Fields that are missing are none that are wrong. */
static fm_status check_fields(const json_t *object, const field_rule *rules, size_t count,
                              fm_error *err)
{
    for (size_t i = 0; i < count; i++) {
        const field_rule *rule = &rules[i];
        const json_t *value = json_object_get(object, rule->name);
        if (value == NULL)
            continue;
        if (rule->type == JSON_TRUE ? !json_is_boolean(value) : json_typeof(value) != rule->type)
            return fm_fail(err, FM_INVALID, "'%s' is not %s", rule->name, type_words(rule->type));
        if (rule->type == JSON_STRING && json_string_length(value) > rule->most_bytes)
            return fm_fail(err, FM_INVALID, "'%s' is longer than %zu bytes", rule->name,
                           rule->most_bytes);
    }
    return FM_OK;
}

static fm_status check_names(const json_t *list, const char *what, fm_error *err)
{
    size_t index;
    const json_t *name;
    if (json_array_size(list) > LIST_LENGTH)
        return fm_fail(err, FM_INVALID, "'%s' has more than %d names", what, LIST_LENGTH);
    json_array_foreach(list, index, name)
    {
        if (!json_is_string(name) || json_string_length(name) > NAME_BYTES)
            return fm_fail(err, FM_INVALID, "'%s' is not a list of names", what);
    }
    return FM_OK;
}

static fm_status check_modelled(const json_t *modelled, fm_error *err)
{
    fm_status status = check_fields(modelled, modelled_fields, COUNT_OF(modelled_fields), err);
    for (size_t i = 0; i < COUNT_OF(modelled_fields) && status == FM_OK; i++)
        status = check_names(json_object_get(modelled, modelled_fields[i].name),
                             modelled_fields[i].name, err);
    return status;
}

static fm_status check_point(const json_t *point, const char *what, fm_error *err)
{
    size_t index;
    const json_t *number;
    if (point != NULL && json_array_size(point) != 3)
        return fm_fail(err, FM_INVALID, "'%s' of the mesh is not three numbers", what);
    json_array_foreach(point, index, number)
    {
        if (!json_is_number(number))
            return fm_fail(err, FM_INVALID, "'%s' of the mesh is not three numbers", what);
    }
    return FM_OK;
}

static bool is_of_mesh_texts(const char *name)
{
    for (size_t i = 0; i < COUNT_OF(mesh_fields); i++)
        if (strcmp(mesh_fields[i].name, name) == 0)
            return true;
    return false;
}

/* Beside its texts a mesh has counts and a distance. */
static fm_status check_mesh(json_t *mesh, fm_error *err)
{
    const char *name;
    json_t *value;
    fm_status status = check_fields(mesh, mesh_fields, COUNT_OF(mesh_fields), err);
    json_object_foreach(mesh, name, value)
    {
        if (status == FM_OK && !is_of_mesh_texts(name) &&
            (!json_is_number(value) || !metric_in_range(FM_RANGE_AMOUNT, json_number_value(value))))
            return fm_fail(err, FM_INVALID, "'%.80s' of the mesh is not a number from 0", name);
    }
    if (status == FM_OK)
        status = check_names(json_object_get(mesh, "ignored"), "ignored", err);
    if (status == FM_OK)
        status = check_point(json_object_get(mesh, "low"), "low", err);
    return status == FM_OK ? check_point(json_object_get(mesh, "high"), "high", err) : status;
}

static bool is_hash(const char *digits)
{
    return digits != NULL && strlen(digits) == HASH_DIGITS &&
           strspn(digits, "0123456789abcdef") == HASH_DIGITS;
}

static fm_status check_hashes(const json_t *hashes, uint32_t frames, fm_error *err)
{
    size_t index;
    const json_t *hash;
    if (json_array_size(hashes) > (size_t)frames + 1)
        return fm_fail(err, FM_INVALID, "%zu 'image_hashes' of %u frames", json_array_size(hashes),
                       frames);
    json_array_foreach(hashes, index, hash)
    {
        if (!is_hash(json_string_value(hash)))
            return fm_fail(err, FM_INVALID, "'image_hashes' are not hashes of 16 digits");
    }
    return FM_OK;
}

/* What is known of a metric or counter. */
typedef struct metric_rule {
    const char *unit;
    fm_metric_of of;
    fm_metric_range range;
} metric_rule;

static bool find_rule(metric_rule *rule, const char *name)
{
    const fm_metric_info *info = metric_describe(name);
    const tbr_counter_info *counter = counter_find(name);
    if (info != NULL)
        *rule = (metric_rule){ info->unit, info->of, info->range };
    else if (counter != NULL)
        *rule = (metric_rule){ counter->unit, FM_OF_CASE, FM_RANGE_COUNT };
    return (info != NULL || counter != NULL) && strlen(name) <= NAME_BYTES;
}

bool answer_value(double *value, const json_t *json)
{
    static const struct {
        const char *text;
        double value;
    } odd[] = { { "inf", INFINITY }, { "-inf", -INFINITY }, { "nan", NAN } };
    *value = json_number_value(json);
    for (size_t i = 0; json_is_string(json) && i < COUNT_OF(odd); i++) {
        *value = odd[i].value;
        if (strcmp(json_string_value(json), odd[i].text) == 0)
            return true;
    }
    return json_is_number(json);
}

static fm_status check_number(const char *name, const json_t *json, fm_metric_of of, fm_error *err)
{
    metric_rule rule = { .unit = "" };
    double value;
    if (!find_rule(&rule, name))
        return fm_fail(err, FM_INVALID, "'%.80s' is no metric", name);
    if (rule.of != of)
        return fm_fail(err, FM_INVALID, "'%.80s' is not a metric of a %s", name,
                       of == FM_OF_FRAME    ? "frame"
                       : of == FM_OF_LAUNCH ? "launch"
                                            : "case");
    if (!answer_value(&value, json))
        return fm_fail(err, FM_INVALID, "'%.80s' is not a number", name);
    if (!metric_in_range(rule.range, value))
        return fm_fail(err, FM_INVALID, "'%.80s' is %.17g, not %s", name, value,
                       fm_ranges[rule.range].words);
    return FM_OK;
}

static fm_status check_numbers(json_t *object, fm_metric_of of, fm_error *err)
{
    const char *name;
    json_t *value;
    fm_status status = FM_OK;
    json_object_foreach(object, name, value)
    {
        if (status == FM_OK)
            status = check_number(name, value, of, err);
    }
    return status;
}

static fm_status check_sample(const json_t *sample, uint32_t frames, fm_error *err)
{
    const json_t *frame = json_object_get(sample, "frame");
    const json_t *value = json_object_get(sample, "value");
    const char *name = json_string_value(json_object_get(sample, "metric"));
    const char *unit = json_string_value(json_object_get(sample, "unit"));
    metric_rule rule = { .unit = "" };
    if (!json_is_integer(frame) || name == NULL || unit == NULL || !json_is_number(value))
        return fm_fail(err, FM_INVALID, "a sample lacks frame, metric, value or unit");
    if (json_integer_value(frame) < 0 || json_integer_value(frame) >= frames)
        return fm_fail(err, FM_INVALID, "a sample is of frame %lld; there are %u",
                       (long long)json_integer_value(frame), frames);
    const fm_status status = check_number(name, value, FM_OF_FRAME, err);
    if (status == FM_OK && find_rule(&rule, name) && strcmp(unit, rule.unit) != 0)
        return fm_fail(err, FM_INVALID, "'%.80s' is in '%.20s', not in '%s'", name, unit,
                       rule.unit);
    return status;
}

static int compare_samples(const void *a, const void *b)
{
    const fm_answer_sample *x = a, *y = b;
    if (x->frame != y->frame)
        return x->frame < y->frame ? -1 : 1;
    return strcmp(x->metric, y->metric);
}

static fm_status check_each_once(const json_t *samples, fm_error *err)
{
    const size_t count = json_array_size(samples);
    fm_status status = FM_OK;
    fm_answer_sample *all = calloc(count + 1, sizeof *all);
    if (all == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu samples", count);
    for (size_t i = 0; i < count; i++)
        all[i] = answer_sample(json_array_get(samples, i));
    qsort(all, count, sizeof *all, compare_samples);
    for (size_t i = 1; i < count && status == FM_OK; i++)
        if (compare_samples(&all[i - 1], &all[i]) == 0)
            status =
                fm_fail(err, FM_INVALID, "frame %u has '%.80s' twice", all[i].frame, all[i].metric);
    free(all);
    return status;
}

static fm_status check_samples(const json_t *samples, uint32_t frames, fm_error *err)
{
    size_t index;
    const json_t *sample;
    fm_status status = FM_OK;
    json_array_foreach(samples, index, sample)
    {
        if (status == FM_OK)
            status = check_sample(sample, frames, err);
    }
    return status == FM_OK ? check_each_once(samples, err) : status;
}

static fm_status check_status(const json_t *answer, fm_error *err)
{
    fm_case_status status;
    if (!case_status_parse(&status, json_string_value(json_object_get(answer, "status"))))
        return fm_fail(err, FM_INVALID, "'status' is none of the known words");
    if ((status == FM_CASE_SKIPPED) != answer_is_runs_fault(answer))
        return fm_fail(err, FM_INVALID, "'status' and 'is_runs_fault' contradict each other");
    return FM_OK;
}

/* It may be missing. */
static fm_status check_reason(const json_t *answer, fm_error *err)
{
    const char *name = json_string_value(json_object_get(answer, "reason")), *nearest;
    fm_reason reason;
    if (name == NULL)
        return FM_OK;
    if (!case_reason_parse(&reason, name, &nearest))
        return fm_fail(err, FM_INVALID, "'reason' is '%.40s'; the nearest is '%s'", name,
                       nearest != NULL ? nearest : case_reason_name(FM_REASON_FEED));
    if (reason != FM_REASON_NONE && answer_status(answer) != FM_CASE_NOT_SUPPORTED)
        return fm_fail(err, FM_INVALID, "'reason' is '%s', and 'status' '%s'", name,
                       case_status_name(answer_status(answer)));
    return FM_OK;
}

fm_status answer_check_reason(const json_t *answer, fm_error *err)
{
    if (answer_status(answer) == FM_CASE_NOT_SUPPORTED && answer_reason(answer) == FM_REASON_NONE)
        return fm_fail(err, FM_INVALID, "'status' is '%s' without a 'reason': %.300s",
                       case_status_name(FM_CASE_NOT_SUPPORTED), answer_message(answer));
    return FM_OK;
}

static fm_status check_code(const json_t *answer, fm_error *err)
{
    fm_code code;
    const bool is_code = json_object_get(answer, "code") == NULL || answer_code(&code, answer);
    if (json_object_get(answer, "code") != NULL)
        code_free(&code);
    return is_code ? FM_OK : fm_fail(err, FM_INVALID, "'code' is not that of code/code_json.h");
}

fm_status answer_check(const json_t *answer, uint32_t frames, fm_error *err)
{
    if (!json_is_object(answer))
        return fm_fail(err, FM_INVALID, "not an object");
    fm_status status = check_fields(answer, answer_fields, COUNT_OF(answer_fields), err);
    if (status == FM_OK)
        status = check_status(answer, err);
    if (status == FM_OK)
        status = check_reason(answer, err);
    if (status == FM_OK)
        status = check_code(answer, err);
    if (status == FM_OK)
        status = check_modelled(answer_modelled(answer), err);
    if (status == FM_OK)
        status = check_mesh(answer_mesh(answer), err);
    if (status == FM_OK)
        status = check_hashes(answer_image_hashes(answer), frames, err);
    if (status == FM_OK)
        status = check_numbers(answer_metrics(answer), FM_OF_CASE, err);
    if (status == FM_OK)
        status = check_numbers(answer_launch(answer), FM_OF_LAUNCH, err);
    return status == FM_OK ? check_samples(answer_samples(answer), frames, err) : status;
}
