/* Where calibrations lie: one file a machine. */
#include <errno.h>
#include <inttypes.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/state.h"
#include "base/text.h"
#include "code/code.h"
#include "noise.h"

enum { SCHEMA = 1, FILE_MAX_BYTES = 1 << 20, DEVICES_MAX = 1000 };

void noise_fingerprint(char digits[17], const fm_machine *machine)
{
    char facts[256];
    const int length = snprintf(facts, sizeof facts, "%s\n%u\n%" PRIu64, machine->cpu,
                                machine->cores, machine->memory_bytes);
    code_digits(digits, code_hash(facts, (size_t)length));
}

fm_status noise_path(char path[FM_PATH_MAX_BYTES], const fm_machine *machine, fm_error *err)
{
    char digits[17], name[64];
    noise_fingerprint(digits, machine);
    snprintf(name, sizeof name, "calibration/%s.json", digits);
    return state_path(path, NULL, name, false, err);
}

static bool read_statistic(ab_noise_statistic *statistic, json_t *json)
{
    json_int_t gates = 0, alarms = 0;
    if (json_unpack(json, "{s:F, s:F, s:F, s:F, s:I, s:I}", "deviation", &statistic->deviation,
                    "standard_error", &statistic->standard_error, "detectable_first",
                    &statistic->detectable_first, "detectable", &statistic->detectable, "gates",
                    &gates, "alarms", &alarms) != 0)
        return false;
    statistic->gates = (uint32_t)gates;
    statistic->alarms = (uint32_t)alarms;
    return statistic->deviation >= 0.0 && statistic->standard_error >= 0.0 &&
           statistic->detectable_first > 0.0 && statistic->detectable > 0.0 && gates >= 0 &&
           gates <= INT32_MAX && alarms >= 0 && alarms <= gates;
}

static bool read_device(ab_noise *noise, json_t *json)
{
    const char *name, *measured;
    json_int_t pairs, planned;
    json_t *statistics;
    *noise = (ab_noise){ .pairs = 0 };
    if (json_unpack(json, "{s:s, s:s, s:I, s:I, s:o}", "device_name", &name, "case", &measured,
                    "pairs", &pairs, "planned", &planned, "statistics", &statistics) != 0 ||
        pairs < 1 || pairs > INT32_MAX || planned < 1 || planned > INT32_MAX)
        return false;
    snprintf(noise->device_name, sizeof noise->device_name, "%s", name);
    snprintf(noise->measured, sizeof noise->measured, "%s", measured);
    noise->pairs = (uint32_t)pairs;
    noise->planned = (uint32_t)planned;
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        json_t *statistic = json_object_get(statistics, ab_statistic_names[s]);
        if (statistic != NULL && !read_statistic(&noise->statistics[s], statistic))
            return false;
    }
    return true;
}

static fm_status read_devices(ab_noise_list *list, const json_t *devices, const char *path,
                              fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < json_array_size(devices) && status == FM_OK; i++) {
        ab_noise noise;
        status = i < DEVICES_MAX && read_device(&noise, json_array_get(devices, i))
                     ? noise_keep(list, &noise, err)
                     : fm_fail(err, FM_INVALID,
                               "%s: device %zu is no calibration; remove the file, and calibrate "
                               "again",
                               path, i + 1);
    }
    return status;
}

static fm_status take(ab_noise_list *list, json_t *file, const char *path,
                      const fm_machine *machine, fm_error *err)
{
    char digits[17];
    json_int_t schema = 0;
    const char *fingerprint = "";
    json_t *devices = NULL;
    noise_fingerprint(digits, machine);
    if (json_unpack(file, "{s:I, s:s, s:o}", "schema", &schema, "fingerprint", &fingerprint,
                    "devices", &devices) != 0 ||
        schema != SCHEMA || !json_is_array(devices))
        return fm_fail(err, FM_INVALID, "%s: no calibration that this program knows", path);
    if (strcmp(fingerprint, digits) != 0)
        return fm_fail(err, FM_INVALID,
                       "%s: the calibration of another machine (%.16s, this one is %s); `fragmark "
                       "calibrate` makes one",
                       path, fingerprint, digits);
    return read_devices(list, devices, path, err);
}

fm_status noise_read(ab_noise_list *list, const char *path, const fm_machine *machine,
                     fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    json_error_t fault = { 0 };
    *list = (ab_noise_list){ 0 };
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FM_OK;
    fm_status status = text_read_file(&bytes, &count, path, FILE_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    json_t *file = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    free(bytes);
    status = file != NULL ? take(list, file, path, machine, err)
                          : fm_fail(err, FM_INVALID, "%s:%d: %s", path, fault.line, fault.text);
    json_decref(file);
    if (status != FM_OK)
        noise_free(list);
    return status;
}

static json_t *device_json(const ab_noise *noise)
{
    json_t *statistics = json_object();
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        const ab_noise_statistic *of = &noise->statistics[s];
        if (of->detectable > 0.0)
            json_object_set_new(statistics, ab_statistic_names[s],
                                json_pack("{s:f, s:f, s:f, s:f, s:I, s:I}", "deviation",
                                          of->deviation, "standard_error", of->standard_error,
                                          "detectable_first", of->detectable_first, "detectable",
                                          of->detectable, "gates", (json_int_t)of->gates, "alarms",
                                          (json_int_t)of->alarms));
    }
    return json_pack("{s:s, s:s, s:I, s:I, s:o}", "device_name", noise->device_name, "case",
                     noise->measured, "pairs", (json_int_t)noise->pairs, "planned",
                     (json_int_t)noise->planned, "statistics", statistics);
}

static json_t *file_json(const ab_noise_list *list, const fm_machine *machine)
{
    char digits[17];
    json_t *devices = json_array();
    noise_fingerprint(digits, machine);
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(devices, device_json(&list->items[i]));
    return json_pack("{s:i, s:s, s:s, s:I, s:I, s:o}", "schema", SCHEMA, "fingerprint", digits,
                     "cpu", machine->cpu, "cores", (json_int_t)machine->cores, "memory_bytes",
                     (json_int_t)machine->memory_bytes, "devices", devices);
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

fm_status noise_write(const char *path, const ab_noise_list *list, const fm_machine *machine,
                      fm_error *err)
{
    json_t *file = file_json(list, machine);
    char *text = file != NULL ? json_dumps(file, JSON_INDENT(2)) : NULL;
    fm_status status = text != NULL ? make_folder_of(path, err)
                                    : fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        status = text_write_file(path, text, strlen(text), err);
    free(text);
    json_decref(file);
    return status;
}
