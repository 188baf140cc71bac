#include "data.h"

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const struct {
    const char *singular, *variable, *in_build, *installed;
} kinds[] = {
    [DATA_METHODS] = { "method", "FRAGMARK_PLUGIN_PATH", "methods", "lib/fragmark/methods" },
    [DATA_SCENES] = { "scene", "FRAGMARK_SCENE_PATH", "scenes", "share/fragmark/scenes" },
    [DATA_FIGURES] = { "figure", "FRAGMARK_FIGURE_PATH", "figures", "share/fragmark/figures" },
    [DATA_REFERENCES] = { "reference", "FRAGMARK_REFERENCE_PATH", "reference",
                          "share/fragmark/reference" },
    [DATA_RECORDER] = { "recorder", "FRAGMARK_RECORDER_PATH", "record", "lib/fragmark/record" },
};
_Static_assert(sizeof kinds / sizeof kinds[0] == DATA_KIND_COUNT, "one row a kind");

fm_status data_program_folder(char folder[FM_PATH_MAX_BYTES], fm_error *err)
{
    const ssize_t length = readlink("/proc/self/exe", folder, FM_PATH_MAX_BYTES - 1);
    if (length <= 0 || length == FM_PATH_MAX_BYTES - 1)
        return fm_fail(err, FM_IO, "/proc/self/exe cannot be read");
    folder[length] = '\0';
    *strrchr(folder, '/') = '\0';
    return FM_OK;
}

const char *data_bundle_folder(data_kind kind)
{
    return kinds[kind].installed;
}

bool data_is_bundle(void)
{
    char folder[FM_PATH_MAX_BYTES], path[FM_PATH_MAX_BYTES];
    return data_program_folder(folder, NULL) == FM_OK &&
           path_join(path, folder, "../" DATA_BUNDLE_MANIFEST, NULL) == FM_OK &&
           access(path, F_OK) == 0;
}

static fm_status keep(fm_text_list *folders, const char *folder, fm_error *err)
{
    return text_list_add(folders, folder)
               ? FM_OK
               : fm_fail(err, FM_NO_MEMORY, "no memory for the names of folders");
}

static fm_status add_given(fm_text_list *folders, data_kind kind, fm_error *err)
{
    fm_status status = FM_OK;
    const char *variable = kinds[kind].variable, *given = getenv(variable);
    char *copy = strdup(given != NULL ? given : ""), *rest = copy;
    if (copy == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %s", variable);
    for (char *item; status == FM_OK && (item = strsep(&rest, ":")) != NULL;) {
        if (*item == '\0')
            continue;
        status = path_is_folder(item, err);
        status = status == FM_OK ? keep(folders, item, err) : fm_error_prefix(err, "%s", variable);
    }
    free(copy);
    return status;
}

/* The program's own may be missing, but not barred. */
static fm_status add_own(fm_text_list *folders, const char *program, const char *place,
                         fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    fm_status status = path_join(folder, program, place, err);
    if (status != FM_OK || access(folder, F_OK) != 0)
        return status;
    status = path_is_folder(folder, err);
    return status == FM_OK ? keep(folders, folder, err) : status;
}

fm_status data_folders(fm_text_list *folders, data_kind kind, fm_error *err)
{
    char program[FM_PATH_MAX_BYTES], installed[FM_PATH_MAX_BYTES];
    fm_status status = add_given(folders, kind, err);
    if (status == FM_OK)
        status = data_program_folder(program, err);
    if (status == FM_OK)
        status = add_own(folders, program, kinds[kind].in_build, err);
    if (status == FM_OK)
        status = path_join(installed, "..", kinds[kind].installed, err);
    return status == FM_OK ? add_own(folders, program, installed, err) : status;
}

/* Adds what a folder's entries that end so are called without the ending. */
static fm_status add_names(fm_text_list *names, const char *folder, const char *ending,
                           fm_error *err)
{
    const size_t cut = strlen(ending);
    fm_status status = FM_OK;
    DIR *entries = opendir(folder);
    const struct dirent *entry;
    while (entries != NULL && status == FM_OK && (entry = readdir(entries)) != NULL) {
        char name[sizeof entry->d_name];
        const size_t length = strlen(entry->d_name);
        if (entry->d_name[0] == '.' || length <= cut ||
            strcmp(entry->d_name + length - cut, ending) != 0)
            continue;
        snprintf(name, sizeof name, "%.*s", (int)(length - cut), entry->d_name);
        status = keep(names, name, err);
    }
    if (entries != NULL)
        closedir(entries);
    return status;
}

static fm_status tell_missing(const fm_text_list *folders, data_kind kind, const char *name,
                              const char *ending, fm_error *err)
{
    fm_text_list names = { 0 };
    fm_status status = FM_OK;
    const char *what = kinds[kind].singular;
    for (size_t i = 0; i < folders->count && status == FM_OK; i++)
        status = add_names(&names, folders->items[i], ending, err);
    const char *nearest = text_nearest(name, text_list_items(&names), names.count);
    if (status == FM_OK && folders->count == 0)
        status = fm_fail(err, FM_INVALID, "no %s '%.200s': there is no folder of them; set %s",
                         what, name, kinds[kind].variable);
    else if (status == FM_OK)
        status =
            fm_fail(err, FM_INVALID, "no %s '%.200s' in %s%s%s%s", what, name,
                    folders->items[folders->count - 1], nearest != NULL ? "; the nearest is '" : "",
                    nearest != NULL ? nearest : "", nearest != NULL ? "'" : "");
    text_list_free(&names);
    return status;
}

fm_status data_find(char path[FM_PATH_MAX_BYTES], data_kind kind, const char *name,
                    const char *ending, fm_error *err)
{
    fm_text_list folders = { 0 };
    char file[FM_PATH_MAX_BYTES];
    bool is_found = false;
    const int length = snprintf(file, sizeof file, "%s%s", name, ending);
    fm_status status = data_folders(&folders, kind, err);
    if (status == FM_OK && (length <= 0 || (size_t)length >= sizeof file))
        status = fm_fail(err, FM_INVALID, "%.64s...: too long a name", name);
    for (size_t i = 0; i < folders.count && status == FM_OK && !is_found; i++) {
        status = path_join(path, folders.items[i], file, err);
        is_found = status == FM_OK && access(path, F_OK) == 0;
    }
    if (status == FM_OK && !is_found)
        status = tell_missing(&folders, kind, name, ending, err);
    text_list_free(&folders);
    return status;
}
