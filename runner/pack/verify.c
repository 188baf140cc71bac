#include "verify.h"

#include <assert.h>
#include <errno.h>
#include <fts.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "archive.h"
#include "base/text_index.h"
#include "bundle/items.h"
#include "bundle/items_json.h"
#include "code/code.h"
#include "differences.h"

/* The files of a folder, and whether each is of the pack. */
typedef struct found_files {
    fm_text_index index; /* paths as seen from the folder */
    fm_text_list paths;
    bool *is_listed; /* [paths.count] */
} found_files;

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the files of a pack");
}

static fm_status tell(fm_text_list *list, const char *file, const char *what, fm_error *err)
{
    char sentence[FM_PATH_MAX_BYTES + 256];
    snprintf(sentence, sizeof sentence, "%s%s%s", file, what[0] != '\0' ? ": " : "", what);
    return text_list_add(list, sentence) ? FM_OK : no_memory(err);
}

static fm_status take_entry(fm_verify_result *result, found_files *found, const FTSENT *entry,
                            size_t skipped, fm_error *err)
{
    const char *path = entry->fts_path + skipped;
    switch (entry->fts_info) {
    case FTS_D:
    case FTS_DP:
        return FM_OK;
    case FTS_F:
        break;
    case FTS_DNR:
    case FTS_ERR:
    case FTS_NS:
        return tell(&result->damaged, path, strerror(entry->fts_errno), err);
    default:
        return tell(&result->damaged, path, "is neither a file nor a folder", err);
    }
    if (strcmp(path, FM_PACK_FILE) == 0)
        return FM_OK;
    return text_index_add(&found->index, path, found->paths.count) != FM_TEXT_INDEX_NONE &&
                   text_list_add(&found->paths, path)
               ? FM_OK
               : no_memory(err);
}

static fm_status find_files(fm_verify_result *result, found_files *found, const char *folder,
                            fm_error *err)
{
    char root[FM_PATH_MAX_BYTES];
    fm_status status = FM_OK;
    snprintf(root, sizeof root, "%s", folder);
    FTS *walk = fts_open((char *const[]){ root, NULL }, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    if (walk == NULL)
        return fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (FTSENT *entry; status == FM_OK && (entry = fts_read(walk)) != NULL;)
        status = take_entry(result, found, entry, strlen(root) + 1, err);
    fts_close(walk);
    found->is_listed = calloc(found->paths.count + 1, sizeof *found->is_listed);
    return status == FM_OK && found->is_listed == NULL ? no_memory(err) : status;
}

static fm_status check_content(fm_verify_result *result, const char *folder, const char *name,
                               json_int_t bytes, const char *hash, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], digits[17], sentence[128];
    struct stat info;
    if (path_join(path, folder, name, NULL) != FM_OK || stat(path, &info) != 0)
        return tell(&result->missing, name, "", err);
    if (info.st_size != bytes) {
        snprintf(sentence, sizeof sentence, "%lld bytes, not %lld", (long long)info.st_size,
                 (long long)bytes);
        return tell(&result->damaged, name, sentence, err);
    }
    code_digits(digits, code_hash_file(path));
    if (strcmp(digits, hash) != 0)
        return tell(&result->damaged, name, "its content is another", err);
    result->files++;
    result->bytes += (uint64_t)bytes;
    return FM_OK;
}

static fm_status check_file(fm_verify_result *result, found_files *found, const char *folder,
                            const json_t *file, fm_error *err)
{
    const char *path = NULL, *hash = NULL;
    json_int_t bytes = -1;
    if (json_unpack((json_t *)(uintptr_t)file, "{s:s, s:I, s:s}", "path", &path, "bytes", &bytes,
                    "xxh3_64", &hash) != 0 ||
        bytes < 0) {
        result->is_foreign = true;
        return fm_fail(err, FM_INVALID, "%s/" FM_PACK_FILE ": a file of its list cannot be",
                       folder);
    }
    const size_t index = text_index_find(&found->index, path);
    if (index == FM_TEXT_INDEX_NONE)
        return tell(&result->missing, path, "", err);
    assert(found->is_listed != NULL);
    found->is_listed[index] = true;
    return check_content(result, folder, path, bytes, hash, err);
}

static fm_status check_files(fm_verify_result *result, const char *folder, const json_t *list,
                             fm_error *err)
{
    found_files found = { .is_listed = NULL };
    const json_t *files = json_object_get(list, "files"), *file;
    size_t i;
    fm_status status = find_files(result, &found, folder, err);
    json_array_foreach(files, i, file)
    {
        if (status == FM_OK)
            status = check_file(result, &found, folder, file, err);
    }
    for (i = 0; i < found.paths.count && status == FM_OK; i++)
        if (!found.is_listed[i])
            status = tell(&result->unlisted, found.paths.items[i], "", err);
    text_index_free(&found.index);
    text_list_free(&found.paths);
    free(found.is_listed);
    return status;
}

static fm_status read_list(fm_verify_result *result, json_t **list, const char *folder,
                           fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = json_read_object(list, folder, FM_PACK_FILE, err);
    if (status == FM_OK && (json_integer_value(json_object_get(*list, "pack")) != 1 ||
                            !json_is_array(json_object_get(*list, "files"))))
        status = fm_fail(err, FM_INVALID, "%s/" FM_PACK_FILE ": is not the list of a pack", folder);
    if (status == FM_OK)
        status = path_join(path, folder, FM_PACK_FILE, err);
    if (status == FM_OK)
        code_digits(result->id, code_hash_file(path));
    if (status == FM_NO_MEMORY || status == FM_OK)
        return status;
    result->is_foreign = true;
    fm_error_prefix(err, "no pack");
    if (err != NULL)
        err->status = FM_INVALID;
    return FM_INVALID;
}

/* A manifest that is damaged says nothing: that it is damaged is told already. */
static fm_status find_differences(fm_verify_result *result, const char *folder,
                                  const fm_plugin_list *plugins, fm_error *err)
{
    json_t *manifest = NULL;
    fm_error below = { 0 };
    if (json_read_object(&manifest, folder, "manifest.json", &below) != FM_OK)
        return FM_OK;
    const fm_status status = differences_find(&result->differences, manifest, plugins, err);
    json_decref(manifest);
    return status;
}

static fm_status verify_folder(fm_verify_result *result, const char *folder,
                               const fm_plugin_list *plugins, fm_error *err)
{
    json_t *list = NULL;
    fm_status status = read_list(result, &list, folder, err);
    if (status == FM_OK)
        status = check_files(result, folder, list, err);
    if (status == FM_OK)
        status = find_differences(result, folder, plugins, err);
    json_decref(list);
    return status;
}

/* The one folder that an archive of a pack holds. */
static fm_status find_top(char top[FM_PATH_MAX_BYTES], const char *folder, fm_error *err)
{
    char root[FM_PATH_MAX_BYTES];
    size_t folders = 0, others = 0;
    snprintf(root, sizeof root, "%s", folder);
    FTS *walk = fts_open((char *const[]){ root, NULL }, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    if (walk == NULL)
        return fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (FTSENT *entry; (entry = fts_read(walk)) != NULL;) {
        if (entry->fts_level != 1 || entry->fts_info == FTS_DP)
            continue;
        folders += entry->fts_info == FTS_D;
        others += entry->fts_info != FTS_D;
        snprintf(top, FM_PATH_MAX_BYTES, "%s", entry->fts_path);
        fts_set(walk, entry, FTS_SKIP);
    }
    fts_close(walk);
    return folders == 1 && others == 0
               ? FM_OK
               : fm_fail(err, FM_INVALID,
                         "no pack: an archive with %zu folders and %zu other "
                         "entries at its top, not one folder",
                         folders, others);
}

static fm_status verify_archive(fm_verify_result *result, const char *path,
                                const fm_plugin_list *plugins, fm_error *err)
{
    char root[FM_PATH_MAX_BYTES], inside[FM_PATH_MAX_BYTES], top[FM_PATH_MAX_BYTES];
    fm_status status = path_make_temporary(root, "fragmark-verify", err);
    if (status == FM_OK)
        status = path_join(inside, root, "pack", err);
    if (status == FM_OK)
        status = path_make_folders(inside, err);
    if (status == FM_OK)
        status = archive_unpack(root, path, err);
    if (status == FM_OK)
        status = find_top(top, inside, err);
    result->is_foreign = status == FM_INVALID;
    if (status == FM_OK)
        status = verify_folder(result, top, plugins, err);
    if (root[0] != '\0')
        tree_remove(root);
    return status;
}

fm_status verify_pack(fm_verify_result *result, const char *path, const fm_plugin_list *plugins,
                      fm_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return fm_fail(err, FM_INVALID, "%s: %s", path, strerror(errno));
    if (S_ISDIR(info.st_mode))
        return verify_folder(result, path, plugins, err);
    if (!S_ISREG(info.st_mode))
        return fm_fail(err, FM_INVALID, "%s: is neither a file nor a folder", path);
    return verify_archive(result, path, plugins, err);
}

void verify_free(fm_verify_result *result)
{
    text_list_free(&result->damaged);
    text_list_free(&result->missing);
    text_list_free(&result->unlisted);
    text_list_free(&result->differences);
}
