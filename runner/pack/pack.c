#include "pack.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "archive.h"
#include "bundle/items_json.h"
#include "bundle/staging.h"
#include "pack_papers.h"

typedef struct packing {
    const fm_pack_desc *desc;
    char root[FM_PATH_MAX_BYTES];   /* beside the output */
    char name[256];                 /* of the folder in the archive */
    char folder[FM_PATH_MAX_BYTES]; /* ROOT/NAME */
    bundle_items items;
    json_t *manifest;
} packing;

static fm_status expect_results(packing *of, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_is_folder(of->desc->directory, err);
    if (status == FM_OK)
        status = path_join(path, of->desc->directory, "summary.csv", err);
    if (status == FM_OK && access(path, R_OK) != 0)
        status = fm_fail(err, FM_INVALID, "%s: holds no results: %s: %s", of->desc->directory, path,
                         strerror(errno));
    if (status == FM_OK)
        status = json_read_object(&of->manifest, of->desc->directory, "manifest.json", err);
    if (status == FM_IO && err != NULL)
        err->status = FM_INVALID;
    return status == FM_IO ? FM_INVALID : status;
}

static fm_status expect_free(const packing *of, fm_error *err)
{
    if (!archive_is_named(of->desc->output))
        return staging_expect_free(of->desc->output, err);
    return access(of->desc->output, F_OK) == 0
               ? fm_fail(err, FM_INVALID, "%s: is there already; name another", of->desc->output)
               : FM_OK;
}

/* What only running launches need, and what a pack of before says of itself, stay behind. */
static bool is_left_out(const char *entry)
{
    static const char *const left[] = { ".", "..", "work", "truth", FM_PACK_FILE, "README" };
    const char *ending = strrchr(entry, '.');
    for (size_t i = 0; i < sizeof left / sizeof left[0]; i++)
        if (strcmp(entry, left[i]) == 0)
            return true;
    return ending != NULL && strcmp(ending, ".partial") == 0;
}

static fm_status add_entry(packing *of, const char *name, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    struct stat info;
    uint32_t count = 0;
    fm_status status = path_join(path, of->desc->directory, name, err);
    if (status != FM_OK)
        return status;
    if (stat(path, &info) == 0 && S_ISDIR(info.st_mode))
        return items_add_tree(&of->items, &count, path, name, NULL, err);
    return items_add(&of->items, path, name, err);
}

static fm_status add_results(packing *of, fm_error *err)
{
    fm_status status = FM_OK;
    DIR *folder = opendir(of->desc->directory);
    if (folder == NULL)
        return fm_fail(err, FM_IO, "%s: %s", of->desc->directory, strerror(errno));
    for (const struct dirent *entry; status == FM_OK && (entry = readdir(folder)) != NULL;)
        if (!is_left_out(entry->d_name))
            status = add_entry(of, entry->d_name, err);
    closedir(folder);
    return status;
}

/* A folder's name that any shell and tar take as it is. */
static void make_name(packing *of)
{
    const char *slash = strrchr(of->desc->output, '/');
    const char *base = slash != NULL ? slash + 1 : of->desc->output;
    snprintf(of->name, sizeof of->name, "%.*s", archive_stem(base), base);
    for (char *at = of->name; *at != '\0'; at++)
        if (strchr("ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789._-", *at) ==
            NULL)
            *at = '_';
    if (of->name[0] == '\0' || of->name[0] == '.' || of->name[0] == '-')
        snprintf(of->name, sizeof of->name, "pack");
}

static fm_status add_readme(packing *of, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, of->root, "README", err);
    if (status == FM_OK)
        status = pack_write_readme(path, of->name, of->manifest, err);
    return status == FM_OK ? items_add(&of->items, path, "README", err) : status;
}

static fm_status fill(packing *of, fm_pack_result *result, fm_error *err)
{
    fm_status status = path_join(of->folder, of->root, of->name, err);
    if (status == FM_OK)
        status = path_make_folders(of->folder, err);
    if (status == FM_OK)
        status = add_results(of, err);
    if (status == FM_OK)
        status = add_readme(of, err);
    items_sort(&of->items);
    /* Twice: the copies, and an archive of them that need not become smaller. */
    if (status == FM_OK)
        status = staging_expect_room(of->root, 2 * items_bytes(&of->items), "packing", err);
    if (status == FM_OK)
        status = items_copy(&of->items, of->folder, err);
    return status == FM_OK ? pack_write_list(result->id, of->folder, &of->items, of->manifest, err)
                           : status;
}

static fm_status put_in_place(const packing *of, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = FM_OK;
    const char *made = of->folder;
    if (archive_is_named(of->desc->output)) {
        status = archive_make(of->root, of->name, of->desc->output, err);
        if (status == FM_OK)
            status = path_join(path, of->root, "archive", err);
        made = path;
    }
    if (status == FM_OK && rename(made, of->desc->output) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", of->desc->output, strerror(errno));
    return status;
}

fm_status pack_make(fm_pack_result *result, const fm_pack_desc *desc, fm_error *err)
{
    packing of = { .desc = desc };
    *result = (fm_pack_result){ 0 };
    make_name(&of);
    fm_status status = expect_results(&of, err);
    if (status == FM_OK)
        status = expect_free(&of, err);
    if (status == FM_OK)
        status = staging_open(of.root, desc->output, err);
    if (status == FM_OK)
        status = fill(&of, result, err);
    if (status == FM_OK)
        status = put_in_place(&of, err);
    result->files = of.items.count;
    result->bytes = items_bytes(&of.items);
    result->is_unfinished =
        status == FM_OK && !json_is_string(json_object_get(of.manifest, "ended"));
    if (of.root[0] != '\0')
        tree_remove(of.root);
    items_free(&of.items);
    json_decref(of.manifest);
    return status;
}
