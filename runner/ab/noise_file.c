/* Where calibrations lie: one file a machine. */
#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/state.h"
#include "base/text.h"
#include "model/hardware.h"
#include "noise.h"

enum { SCHEMA = 1, FILE_MAX_BYTES = 1 << 20, DEVICES_MAX = 1000, CORES_BYTES = 24 };

static const double gib = 1 << 30;

static fm_hardware hardware_of(char cores[CORES_BYTES], const fm_machine *machine)
{
    snprintf(cores, CORES_BYTES, "%u", machine->cores);
    return (fm_hardware){ machine->cpu, cores, (double)machine->memory_bytes };
}

/* Of which machine a file is; texts are the file's. */
static bool read_hardware(fm_hardware *hardware, char cores[CORES_BYTES], json_t *file)
{
    json_int_t count = 0;
    if (json_unpack(file, "{s:s, s:I, s:F}", "cpu", &hardware->cpu, "cores", &count, "memory_bytes",
                    &hardware->memory_bytes) != 0)
        return false;
    snprintf(cores, CORES_BYTES, "%lld", (long long)count);
    hardware->cores = cores;
    return true;
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
    char cores_there[CORES_BYTES], cores_here[CORES_BYTES];
    json_int_t schema = 0;
    json_t *devices = NULL;
    fm_hardware there;
    const fm_hardware here = hardware_of(cores_here, machine);
    if (json_unpack(file, "{s:I, s:o}", "schema", &schema, "devices", &devices) != 0 ||
        schema != SCHEMA || !json_is_array(devices) || !read_hardware(&there, cores_there, file))
        return fm_fail(err, FM_INVALID, "%s: no calibration that this program knows", path);
    if (!hardware_is_same(&there, &here))
        return fm_fail(err, FM_INVALID,
                       "%s: the calibration of another machine (%.100s, %s cores, %.4g GiB; this "
                       "one is %s, %s cores, %.4g GiB); `fragmark calibrate` makes one",
                       path, there.cpu, there.cores, there.memory_bytes / gib, here.cpu, here.cores,
                       here.memory_bytes / gib);
    return read_devices(list, devices, path, err);
}

/* The caller drops *file, which is NULL on failure. */
static fm_status load(json_t **file, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    json_error_t fault = { 0 };
    *file = NULL;
    const fm_status status = text_read_file(&bytes, &count, path, FILE_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    *file = json_loadb(bytes, count, JSON_REJECT_DUPLICATES, &fault);
    free(bytes);
    return *file != NULL ? FM_OK
                         : fm_fail(err, FM_INVALID, "%s:%d: %s", path, fault.line, fault.text);
}

fm_status noise_folder(char folder[FM_PATH_MAX_BYTES], fm_error *err)
{
    return state_path(folder, NULL, "calibration", false, err);
}

/* A file of a machine that is the same, and when it was written last. */
typedef struct noise_place {
    const fm_hardware *hardware;
    char path[FM_PATH_MAX_BYTES]; /* "": none so far */
    struct timespec written;
} noise_place;

static bool is_later(const struct timespec *a, const struct timespec *b)
{
    return a->tv_sec != b->tv_sec ? a->tv_sec > b->tv_sec : a->tv_nsec > b->tv_nsec;
}

/* Takes the file if it is the machine's, and later than what was found. */
static fm_status look_at(noise_place *found, const char *path, fm_error *err)
{
    char cores[CORES_BYTES];
    fm_hardware there;
    struct stat info;
    json_t *file;
    fm_status status = load(&file, path, err);
    if (status == FM_OK && !read_hardware(&there, cores, file))
        status = fm_fail(err, FM_INVALID, "%s: no calibration that this program knows", path);
    if (status == FM_OK && hardware_is_same(&there, found->hardware) && stat(path, &info) == 0 &&
        (found->path[0] == '\0' || is_later(&info.st_mtim, &found->written))) {
        strcpy(found->path, path);
        found->written = info.st_mtim;
    }
    json_decref(file);
    return status;
}

static int is_calibration(const struct dirent *entry)
{
    const char *end = strrchr(entry->d_name, '.');
    return entry->d_name[0] != '.' && end != NULL && strcmp(end, ".json") == 0;
}

static fm_status look_through(noise_place *found, const char *folder, fm_error *err)
{
    struct dirent **entries = NULL;
    fm_status status = FM_OK;
    const int count = scandir(folder, &entries, is_calibration, alphasort);
    if (count < 0)
        return errno == ENOENT ? FM_OK : fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        char path[FM_PATH_MAX_BYTES];
        if (status == FM_OK)
            status = path_join(path, folder, entries[i]->d_name, err);
        if (status == FM_OK)
            status = look_at(found, path, err);
        free(entries[i]);
    }
    free(entries);
    return status;
}

fm_status noise_find(char path[FM_PATH_MAX_BYTES], const char *folder, const fm_machine *machine,
                     fm_error *err)
{
    char cores[CORES_BYTES], fingerprint[FM_FINGERPRINT_BYTES], name[FM_FINGERPRINT_BYTES + 8];
    const fm_hardware here = hardware_of(cores, machine);
    noise_place found = { .hardware = &here };
    path[0] = '\0';
    const fm_status status = look_through(&found, folder, err);
    if (status == FM_OK && found.path[0] != '\0')
        strcpy(path, found.path);
    if (status != FM_OK || found.path[0] != '\0')
        return status;
    hardware_fingerprint(fingerprint, &here);
    snprintf(name, sizeof name, "%s.json", fingerprint);
    return path_join(path, folder, name, err);
}

fm_status noise_read(ab_noise_list *list, const char *path, const fm_machine *machine,
                     fm_error *err)
{
    json_t *file = NULL;
    *list = (ab_noise_list){ 0 };
    if (access(path, F_OK) != 0 && errno == ENOENT)
        return FM_OK;
    fm_status status = load(&file, path, err);
    if (status == FM_OK)
        status = take(list, file, path, machine, err);
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
    json_t *devices = json_array();
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(devices, device_json(&list->items[i]));
    return json_pack("{s:i, s:s, s:I, s:I, s:o}", "schema", SCHEMA, "cpu", machine->cpu, "cores",
                     (json_int_t)machine->cores, "memory_bytes", (json_int_t)machine->memory_bytes,
                     "devices", devices);
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
