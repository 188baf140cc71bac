#include "merged_files.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <unistd.h>

#include "bundle/items.h"

/* A file of a case begins with its id: images/ID.rgba32f. */
static bool is_of_folder(const shard_set *set, size_t folder, const char *name)
{
    char id[17];
    if (strlen(name) < sizeof id || name[sizeof id - 1] != '.')
        return false;
    snprintf(id, sizeof id, "%.16s", name);
    const size_t index = text_index_find(&set->ids, id);
    return index != FM_TEXT_INDEX_NONE && set->taken[index].folder == folder;
}

static fm_status add_file(bundle_items *items, const char *folder, const char *below,
                          const char *name, fm_error *err)
{
    char from[FM_PATH_MAX_BYTES], to[FM_PATH_MAX_BYTES];
    fm_status status = path_join(to, below, name, err);
    if (status == FM_OK)
        status = path_join(from, folder, to, err);
    return status == FM_OK ? items_add(items, from, to, err) : status;
}

/* set NULL: all files of the folder. */
static fm_status add_folder(bundle_items *items, const shard_set *set, size_t folder,
                            const char *path, const char *below, fm_error *err)
{
    char whole[FM_PATH_MAX_BYTES];
    fm_status status = path_join(whole, path, below, err);
    if (status != FM_OK)
        return status;
    DIR *files = opendir(whole);
    if (files == NULL)
        return errno == ENOENT ? FM_OK : fm_fail(err, FM_IO, "%s: %s", whole, strerror(errno));
    for (const struct dirent *file; status == FM_OK && (file = readdir(files)) != NULL;) {
        const bool is_wanted =
            file->d_name[0] != '.' && (set == NULL || is_of_folder(set, folder, file->d_name));
        if (is_wanted)
            status = add_file(items, path, below, file->d_name, err);
    }
    closedir(files);
    return status;
}

static fm_status add_common(bundle_items *items, const char *path, fm_error *err)
{
    char memory[FM_PATH_MAX_BYTES];
    fm_status status = add_folder(items, NULL, 0, path, "specs", err);
    if (status == FM_OK)
        status = path_join(memory, path, "memory.csv", err);
    if (status == FM_OK && access(memory, F_OK) == 0)
        status = items_add(items, memory, "memory.csv", err);
    return status;
}

fm_status merged_files_copy(const shard_set *set, const char *directory, fm_error *err)
{
    bundle_items items = { 0 };
    fm_status status = add_common(&items, set->folders[0].path, err);
    for (size_t i = 0; i < set->count && status == FM_OK; i++) {
        status = add_folder(&items, set, i, set->folders[i].path, "images", err);
        if (status == FM_OK)
            status = add_folder(&items, set, i, set->folders[i].path, "kept", err);
    }
    if (status == FM_OK)
        status = items_copy(&items, directory, err);
    items_free(&items);
    return status;
}
