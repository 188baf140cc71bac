#include <errno.h>
#include <fcntl.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

#include "baseline.h"
#include "files.h"

enum { PARTIALS = 100 };

/* Copies into `to`; *hashes is a new object. */
static fm_status copy_files(json_t **hashes, const char *to, const char *from, fm_error *err)
{
    *hashes = json_object();
    for (size_t i = 0; i < BASELINE_FILES; i++) {
        char hash[BASELINE_HASH_BYTES];
        const fm_status status = baseline_hash(hash, from, baseline_files[i].name, to, err);
        if (status != FM_OK)
            return status;
        if (hash[0] == '\0' && baseline_files[i].is_needed)
            return fm_fail(err, FM_INVALID, "%s: has no %s", from, baseline_files[i].name);
        if (hash[0] != '\0')
            json_object_set_new(*hashes, baseline_files[i].name, json_string(hash));
    }
    return FM_OK;
}

/* Texts of a manifest are UTF-8: it was JSON. A path may be anything. */
static json_t *describe(const char *name, const char *machine, const fm_result_files *results,
                        json_t *hashes)
{
    char now[32] = "", *from = realpath(results->directory, NULL);
    const fm_provenance *manifest = results->manifest;
    const fm_hardware hardware = provenance_hardware(manifest);
    const time_t seconds = time(NULL);
    struct tm utc;
    if (gmtime_r(&seconds, &utc) != NULL)
        strftime(now, sizeof now, "%Y-%m-%dT%H:%M:%SZ", &utc);
    if (from != NULL)
        text_make_utf8(from);
    json_t *made = json_pack(
        "{s:i, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:s, s:f, s:I, s:O}", "schema", 1, "name",
        name, "machine", machine, "from", from != NULL ? from : "", "set", now, "run_id",
        provenance_fact(manifest, "run_id"), "started", provenance_fact(manifest, "started"),
        "git_commit", provenance_fact(manifest, "git_commit"), "cpu", hardware.cpu, "cores",
        hardware.cores, "memory_bytes", hardware.memory_bytes, "cases", (json_int_t)results->count,
        "files", hashes);
    free(from);
    return made;
}

static fm_status write_description(const char *folder, json_t *description, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, folder, "baseline.json", err);
    char *text = description != NULL ? json_dumps(description, JSON_INDENT(2)) : NULL;
    if (text == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory for baseline.json", folder);
    if (status == FM_OK)
        status = text_write_file(path, text, strlen(text), err);
    free(text);
    return status;
}

static fm_status fill(const char *folder, const char *name, const char *machine,
                      const fm_result_files *results, fm_error *err)
{
    json_t *hashes = NULL, *description = NULL;
    fm_status status = copy_files(&hashes, folder, results->directory, err);
    if (status == FM_OK) {
        description = describe(name, machine, results, hashes);
        status = write_description(folder, description, err);
    }
    json_decref(description);
    json_decref(hashes);
    return status;
}

/* A folder that nobody had before: what a killed process left is no part of it. */
static fm_status make_partial(char made[FM_PATH_MAX_BYTES], const char *folder, fm_error *err)
{
    fm_status status = path_make_folders(folder, err);
    for (unsigned i = 0; i < PARTIALS && status == FM_OK; i++) {
        char name[48];
        snprintf(name, sizeof name, ".partial-%ld-%u", (long)getpid(), i);
        status = path_join(made, folder, name, err);
        if (status == FM_OK && mkdir(made, 0777) == 0)
            return FM_OK;
        if (status == FM_OK && errno != EEXIST)
            status = fm_fail(err, FM_IO, "%s: %s", made, strerror(errno));
    }
    return status == FM_OK ? fm_fail(err, FM_IO,
                                     "%s: the folders .partial-* are of killed processes: "
                                     "remove them",
                                     folder)
                           : status;
}

/* The old one, if there is one, is then where the new one was made, and goes with it. Where a disk
 * cannot exchange two folders, the old one goes first. */
static fm_status put_in_place(const char *made, const char *path, fm_error *err)
{
    if (renameat2(AT_FDCWD, made, AT_FDCWD, path, RENAME_EXCHANGE) == 0 || rename(made, path) == 0)
        return FM_OK;
    baseline_remove(path);
    if (rename(made, path) == 0)
        return FM_OK;
    return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
}

/* The fingerprint under which the name has this machine, or the machine's own. */
static fm_status choose_machine(char machine[FM_FINGERPRINT_BYTES], const char *store,
                                const char *name, const fm_hardware *hardware, fm_error *err)
{
    fm_baseline_list list;
    const fm_status status = baselines_read(&list, store, name, err);
    hardware_fingerprint(machine, hardware);
    for (size_t i = 0; i < list.count && status == FM_OK; i++) {
        const fm_hardware known = {
            baseline_fact(&list.items[i], "cpu"), baseline_fact(&list.items[i], "cores"),
            json_number_value(json_object_get(list.items[i].json, "memory_bytes"))
        };
        if (hardware_is_same(&known, hardware))
            memcpy(machine, list.items[i].machine, FM_FINGERPRINT_BYTES);
    }
    baselines_free(&list);
    return status;
}

static fm_status check(const char *name, const fm_hardware *hardware,
                       const fm_result_files *results, fm_error *err)
{
    if (!baseline_is_name(name))
        return fm_fail(err, FM_UNSUPPORTED,
                       "'%.80s' is no name of a baseline: letters, digits, '.', '_' and '-', at "
                       "most %d, and no '.' first",
                       name, FM_BASELINE_NAME_BYTES - 1);
    return hardware_is_known(hardware)
               ? FM_OK
               : fm_fail(err, FM_UNSUPPORTED,
                         "%s/manifest.json: cpu, cores or memory_bytes is not told: which machine "
                         "measured is not known",
                         results->directory);
}

fm_status baseline_set(char path[FM_PATH_MAX_BYTES], const char *store, const char *name,
                       const fm_result_files *results, fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES], made[FM_PATH_MAX_BYTES];
    char machine[FM_FINGERPRINT_BYTES];
    const fm_hardware hardware = provenance_hardware(results->manifest);
    fm_status status = check(name, &hardware, results, err);
    if (status == FM_OK)
        status = choose_machine(machine, store, name, &hardware, err);
    if (status == FM_OK)
        status = path_join(folder, store, name, err);
    if (status == FM_OK)
        status = path_join(path, folder, machine, err);
    if (status == FM_OK)
        status = make_partial(made, folder, err);
    if (status != FM_OK)
        return status;
    status = fill(made, name, machine, results, err);
    if (status == FM_OK)
        status = put_in_place(made, path, err);
    baseline_remove(made);
    return status;
}
