#include "baseline.h"

#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "files.h"

enum { DESCRIPTION_BYTES = 1 << 16 };

const char *baseline_fact(const fm_baseline *baseline, const char *name)
{
    const char *value = json_string_value(json_object_get(baseline->json, name));
    return value != NULL ? value : "";
}

static fm_status read_json(json_t **json, const char *path, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    json_error_t where;
    *json = NULL;
    const fm_status status = text_read_file(&bytes, &count, path, DESCRIPTION_BYTES, err);
    if (status != FM_OK)
        return status;
    *json = json_loadb(bytes, count, 0, &where);
    free(bytes);
    if (*json == NULL)
        return fm_fail(err, FM_INVALID, "%s:%d: %s", path, where.line, where.text);
    return json_integer_value(json_object_get(*json, "schema")) == 1 &&
                   json_is_object(json_object_get(*json, "files"))
               ? FM_OK
               : fm_fail(err, FM_INVALID, "%s: no baseline of this fragmark", path);
}

/* Takes the folder STORE/name/machine, if it is one of a baseline. */
static fm_status take_machine(fm_baseline_list *list, const char *folder, const char *name,
                              const char *machine, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_baseline *items = realloc(list->items, (list->count + 1) * sizeof *items);
    if (items == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu baselines", list->count + 1);
    list->items = items;
    fm_baseline *added = &items[list->count];
    *added = (fm_baseline){ 0 };
    strcpy(added->name, name);
    strcpy(added->machine, machine);
    fm_status status = path_join(added->path, folder, machine, err);
    if (status == FM_OK)
        status = path_join(path, added->path, "baseline.json", err);
    json_t *json = NULL;
    if (status == FM_OK)
        status = read_json(&json, path, err);
    added->json = json;
    list->count++; /* so that its JSON is freed */
    return status;
}

static int is_visible(const struct dirent *entry)
{
    return baseline_is_name(entry->d_name);
}

/* The names of a folder's entries, in order; without the folder none. */
static fm_status list_names(fm_text_list *names, const char *folder, fm_error *err)
{
    struct dirent **entries = NULL;
    const int count = scandir(folder, &entries, is_visible, alphasort);
    bool has_memory = true;
    if (count < 0)
        return errno == ENOENT ? FM_OK : fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        has_memory = has_memory && text_list_add(names, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return has_memory ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%s: no memory", folder);
}

static fm_status take_name(fm_baseline_list *list, const char *store, const char *name,
                           fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    fm_text_list machines = { 0 };
    fm_status status = path_join(folder, store, name, err);
    if (status == FM_OK)
        status = list_names(&machines, folder, err);
    for (size_t i = 0; i < machines.count && status == FM_OK; i++)
        if (strlen(machines.items[i]) < FM_FINGERPRINT_BYTES)
            status = take_machine(list, folder, name, machines.items[i], err);
    text_list_free(&machines);
    return status;
}

fm_status baselines_read(fm_baseline_list *list, const char *store, const char *name, fm_error *err)
{
    fm_text_list names = { 0 };
    *list = (fm_baseline_list){ 0 };
    if (name != NULL)
        return baseline_is_name(name) ? take_name(list, store, name, err) : FM_OK;
    fm_status status = list_names(&names, store, err);
    for (size_t i = 0; i < names.count && status == FM_OK; i++)
        status = take_name(list, store, names.items[i], err);
    text_list_free(&names);
    return status;
}

void baselines_free(fm_baseline_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        json_decref(list->items[i].json);
    free(list->items);
    *list = (fm_baseline_list){ 0 };
}

fm_status baseline_check(const fm_baseline *baseline, fm_error *err)
{
    const json_t *files = json_object_get(baseline->json, "files");
    for (size_t i = 0; i < BASELINE_FILES; i++) {
        char hash[BASELINE_HASH_BYTES];
        const char *name = baseline_files[i].name;
        const char *known = json_string_value(json_object_get(files, name));
        const fm_status status = baseline_hash(hash, baseline->path, name, NULL, err);
        if (status != FM_OK)
            return status;
        if (strcmp(hash, known != NULL ? known : "") != 0)
            return fm_fail(err, FM_INVALID, "%s/%s: %s since the baseline was set", baseline->path,
                           name, hash[0] == '\0' ? "gone" : "changed");
    }
    return FM_OK;
}

static fm_status refuse_name(const char *store, const char *name, fm_error *err)
{
    fm_text_list names = { 0 };
    const fm_status status = list_names(&names, store, err);
    if (status == FM_OK) {
        const char *nearest = text_nearest(name, text_list_items(&names), names.count);
        fm_fail(err, FM_UNSUPPORTED, "no baseline '%.80s' in %s%s%s%s", name, store,
                nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                nearest != NULL ? "'" : "; `fragmark baseline set NAME DIR` sets one");
    }
    text_list_free(&names);
    return status == FM_OK ? FM_UNSUPPORTED : status;
}

static fm_status refuse_machine(const fm_baseline_list *list, const char *name, fm_error *err)
{
    fm_text machines = { 0 };
    for (size_t i = 0; i < list->count; i++)
        text_add(&machines, "%s%s@%s (%s)", i > 0 ? ", " : "", name, list->items[i].machine,
                 baseline_fact(&list->items[i], "cpu"));
    fm_fail(err, FM_UNSUPPORTED,
            "baseline '%s' has no run of the machine that is asked for; there are: %s", name,
            machines.bytes != NULL ? machines.bytes : "");
    text_free(&machines);
    return FM_UNSUPPORTED;
}

static bool is_wanted(const fm_baseline *baseline, const char *machine, const fm_hardware *here)
{
    const fm_hardware there = { baseline_fact(baseline, "cpu"), baseline_fact(baseline, "cores"),
                                json_number_value(
                                    json_object_get(baseline->json, "memory_bytes")) };
    return machine != NULL ? strcmp(baseline->machine, machine) == 0
                           : hardware_is_same(&there, here);
}

static fm_status choose(char path[FM_PATH_MAX_BYTES], const fm_baseline_list *list,
                        const char *name, const char *machine, const fm_hardware *here,
                        fm_error *err)
{
    for (size_t i = 0; i < list->count; i++)
        if (is_wanted(&list->items[i], machine, here)) {
            strcpy(path, list->items[i].path);
            return baseline_check(&list->items[i], err);
        }
    return refuse_machine(list, name, err);
}

fm_status baseline_find(char path[FM_PATH_MAX_BYTES], const char *store, const char *wanted,
                        const fm_provenance *now, fm_error *err)
{
    fm_baseline_list list;
    const fm_hardware here = provenance_hardware(now);
    const size_t length = strcspn(wanted, "@");
    char *name = strndup(wanted, length);
    path[0] = '\0';
    if (name == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a name");
    fm_status status = baselines_read(&list, store, name, err);
    if (status == FM_OK && list.count == 0)
        status = refuse_name(store, name, err);
    if (status == FM_OK)
        status = choose(path, &list, name, wanted[length] == '@' ? wanted + length + 1 : NULL,
                        &here, err);
    baselines_free(&list);
    free(name);
    return status;
}

void baselines_add_lines(fm_text *text, const fm_baseline_list *list)
{
    if (list->count == 0)
        text_add(text, "no baseline; `fragmark baseline set NAME DIR` sets one\n");
    else
        text_add(text, "%-16s  %-8s  %-20s  %-10s  %s\n", "name", "machine", "started", "commit",
                 "from");
    for (size_t i = 0; i < list->count; i++) {
        const fm_baseline *baseline = &list->items[i];
        text_add(text, "%-16s  %-8s  %-20s  %-10.10s  %s\n", baseline->name, baseline->machine,
                 baseline_fact(baseline, "started"), baseline_fact(baseline, "git_commit"),
                 baseline_fact(baseline, "from"));
    }
}

fm_status baselines_add_json(fm_text *json, const fm_baseline_list *list, fm_error *err)
{
    json_t *all = json_array();
    for (size_t i = 0; i < list->count; i++)
        json_array_append(all, list->items[i].json);
    char *text = json_array_size(all) == list->count ? json_dumps(all, JSON_INDENT(2)) : NULL;
    if (text != NULL)
        text_add(json, "%s\n", text);
    json_decref(all);
    const bool is_made = text != NULL && !json->failed;
    free(text);
    return is_made ? FM_OK
                   : fm_fail(err, FM_NO_MEMORY, "no memory for JSON of %zu baselines", list->count);
}
