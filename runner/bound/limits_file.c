/* One file for all devices: STATE/devices.json. */
#include <errno.h>
#include <jansson.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/state.h"
#include "base/text.h"
#include "limits.h"

enum { SCHEMA = 1, FILE_MAX_BYTES = 1 << 20, DEVICES_MAX = 1000 };

fm_status limits_path(char path[FM_PATH_MAX_BYTES], fm_error *err)
{
    return state_path(path, NULL, "devices.json", false, err);
}

/* [median] or [median, low, high]. */
static bool read_value(fm_interval *value, const json_t *json)
{
    double numbers[3] = { NAN, NAN, NAN };
    const size_t count = json_array_size(json);
    if (count != 1 && count != 3)
        return false;
    for (size_t i = 0; i < count; i++) {
        numbers[i] = json_number_value(json_array_get(json, i));
        if (!(numbers[i] > 0.0) || !isfinite(numbers[i]))
            return false;
    }
    *value = (fm_interval){ numbers[0], numbers[1], numbers[2] };
    return count == 1 || (numbers[1] <= numbers[0] && numbers[0] <= numbers[2]);
}

static bool read_text(char *text, size_t room, const json_t *json, const char *name)
{
    const char *value = json_string_value(json_object_get(json, name));
    return value != NULL && snprintf(text, room, "%s", value) < (int)room;
}

static bool read_device(fm_device_limits *limits, const json_t *json)
{
    fm_limits_key *key = &limits->key;
    const json_int_t cores = json_integer_value(json_object_get(json, "cores"));
    *limits = (fm_device_limits){ .key = { .cores = (uint32_t)cores } };
    if (cores < 1 || cores > INT32_MAX ||
        !read_text(key->device_name, sizeof key->device_name, json, "device_name") ||
        !read_text(key->driver, sizeof key->driver, json, "driver") ||
        !read_text(key->cpu, sizeof key->cpu, json, "cpu"))
        return false;
    const json_t *values = json_object_get(json, "limits");
    if (!json_is_object(values))
        return false;
    for (int i = 0; i < FM_LIMIT_COUNT; i++) {
        const json_t *value = json_object_get(values, fm_limits[i].name);
        limits->values[i] = (fm_interval){ NAN, NAN, NAN };
        if (value != NULL && !read_value(&limits->values[i], value))
            return false;
    }
    return true;
}

static fm_status read_devices(fm_limits_list *list, const json_t *devices, const char *path,
                              fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < json_array_size(devices) && status == FM_OK; i++) {
        fm_device_limits limits;
        status = i < DEVICES_MAX && read_device(&limits, json_array_get(devices, i))
                     ? limits_keep(list, &limits, err)
                     : fm_fail(err, FM_INVALID,
                               "%s: device %zu has no limits that can be read; remove the file, "
                               "and `fragmark calibrate device` again",
                               path, i + 1);
    }
    return status;
}

fm_status limits_read(fm_limits_list *list, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    json_error_t fault = { 0 };
    *list = (fm_limits_list){ 0 };
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FM_OK;
    fm_status status = text_read_file(&bytes, &count, path, FILE_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    json_t *file = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    const json_t *devices = json_object_get(file, "devices");
    free(bytes);
    if (file == NULL)
        status = fm_fail(err, FM_INVALID, "%s:%d: %s", path, fault.line, fault.text);
    else if (json_integer_value(json_object_get(file, "schema")) != SCHEMA ||
             !json_is_array(devices))
        status = fm_fail(err, FM_INVALID, "%s: no limits that this program knows", path);
    else
        status = read_devices(list, devices, path, err);
    json_decref(file);
    if (status != FM_OK)
        limits_free(list);
    return status;
}

static json_t *values_json(const fm_device_limits *limits)
{
    json_t *values = json_object();
    for (int i = 0; i < FM_LIMIT_COUNT; i++) {
        const fm_interval *value = &limits->values[i];
        if (isnan(value->median))
            continue;
        json_object_set_new(values, fm_limits[i].name,
                            interval_is_known(value)
                                ? json_pack("[f, f, f]", value->median, value->low, value->high)
                                : json_pack("[f]", value->median));
    }
    return values;
}

json_t *limits_json(const fm_device_limits *limits)
{
    const fm_limits_key *key = &limits->key;
    return json_pack("{s:s, s:s, s:s, s:I, s:o}", "device_name", key->device_name, "driver",
                     key->driver, "cpu", key->cpu, "cores", (json_int_t)key->cores, "limits",
                     values_json(limits));
}

static fm_status make_folder_of(const char *path, fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    const char *slash = strrchr(path, '/');
    if (slash == NULL || slash == path)
        return FM_OK;
    snprintf(folder, sizeof folder, "%.*s", (int)(slash - path), path);
    return path_make_folders(folder, err);
}

fm_status limits_write(const char *path, const fm_limits_list *list, fm_error *err)
{
    json_t *devices = json_array();
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(devices, limits_json(&list->items[i]));
    json_t *file = json_pack("{s:i, s:o}", "schema", SCHEMA, "devices", devices);
    char *text = file != NULL ? json_dumps(file, JSON_INDENT(2)) : NULL;
    fm_status status = text != NULL ? make_folder_of(path, err)
                                    : fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        status = text_write_file(path, text, strlen(text), err);
    free(text);
    json_decref(file);
    return status;
}
