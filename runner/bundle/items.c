#include "items.h"

#include <errno.h>
#include <fts.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include "base/path.h"

enum { BLOCK_BYTES = 1 << 16 };

static fm_status check_file(bundle_item *item, fm_error *err)
{
    struct stat info;
    if (stat(item->from, &info) != 0 || access(item->from, R_OK) != 0)
        return fm_fail(err, FM_IO, "%s: %s", item->from, strerror(errno));
    if (!S_ISREG(info.st_mode))
        return fm_fail(err, FM_IO, "%s: is not a file", item->from);
    item->bytes = (uint64_t)info.st_size;
    item->is_program = (info.st_mode & S_IXUSR) != 0;
    return FM_OK;
}

fm_status items_add(bundle_items *items, const char *from, const char *to, fm_error *err)
{
    const size_t at = text_index_add(&items->index, to, items->count);
    if (at != items->count && at != FM_TEXT_INDEX_NONE)
        return FM_OK;
    if (at == FM_TEXT_INDEX_NONE)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu files", items->count + 1);
    bundle_item *grown = reallocarray(items->items, items->count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu files", items->count + 1);
    items->items = grown;
    bundle_item *item = &grown[items->count++];
    *item = (bundle_item){ .from = strdup(from), .to = strdup(to) };
    if (item->from == NULL || item->to == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu files", items->count);
    return check_file(item, err);
}

static bool ends_as_one(const char *name, const char *const *endings)
{
    const char *ending = strrchr(name, '.');
    for (; ending != NULL && *endings != NULL; endings++)
        if (strcasecmp(ending, *endings) == 0)
            return true;
    return false;
}

static fm_status add_entry(bundle_items *items, const FTSENT *entry, size_t skipped, const char *to,
                           const char *const *endings, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    if (entry->fts_info == FTS_DNR || entry->fts_info == FTS_ERR || entry->fts_info == FTS_NS)
        return fm_fail(err, FM_IO, "%s: %s", entry->fts_path, strerror(entry->fts_errno));
    if (entry->fts_info != FTS_F || (endings != NULL && !ends_as_one(entry->fts_name, endings)))
        return FM_OK;
    const fm_status status = path_join(path, to, entry->fts_path + skipped, err);
    return status == FM_OK ? items_add(items, entry->fts_path, path, err) : status;
}

fm_status items_add_tree(bundle_items *items, uint32_t *count, const char *folder, const char *to,
                         const char *const *endings, fm_error *err)
{
    char root[FM_PATH_MAX_BYTES];
    const size_t before = items->count;
    fm_status status = path_is_folder(folder, err);
    if (status != FM_OK)
        return status;
    snprintf(root, sizeof root, "%s", folder);
    FTS *walk = fts_open((char *const[]){ root, NULL }, FTS_LOGICAL | FTS_NOCHDIR, NULL);
    if (walk == NULL)
        return fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (FTSENT *entry; status == FM_OK && (entry = fts_read(walk)) != NULL;)
        status = add_entry(items, entry, strlen(root) + 1, to, endings, err);
    fts_close(walk);
    *count += (uint32_t)(items->count - before);
    return status;
}

uint64_t items_bytes(const bundle_items *items)
{
    uint64_t bytes = 0;
    for (size_t i = 0; i < items->count; i++)
        bytes += items->items[i].bytes;
    return bytes;
}

static int compare_items(const void *left, const void *right)
{
    const bundle_item *a = left, *b = right;
    return strcmp(a->to, b->to);
}

void items_sort(bundle_items *items)
{
    if (items->count > 0)
        qsort(items->items, items->count, sizeof *items->items, compare_items);
}

/* The folders above a file of the bundle; those of root are there. */
static fm_status make_folders(char *path, size_t root_length, fm_error *err)
{
    for (char *slash = strchr(path + root_length + 1, '/'); slash != NULL;
         slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        const bool is_there = mkdir(path, 0777) == 0 || errno == EEXIST;
        if (!is_there)
            fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
        *slash = '/';
        if (!is_there)
            return FM_IO;
    }
    return FM_OK;
}

static fm_status copy_bytes(bundle_item *item, FILE *from, FILE *to, const char *path,
                            fm_error *err)
{
    char block[BLOCK_BYTES];
    size_t count;
    XXH3_state_t *state = XXH3_createState();
    if (state == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a hash");
    XXH3_64bits_reset(state);
    item->bytes = 0;
    while ((count = fread(block, 1, sizeof block, from)) > 0 &&
           fwrite(block, 1, count, to) == count) {
        XXH3_64bits_update(state, block, count);
        item->bytes += count;
    }
    snprintf(item->hash, sizeof item->hash, "%016llx",
             (unsigned long long)XXH3_64bits_digest(state));
    XXH3_freeState(state);
    if (ferror(from))
        return fm_fail(err, FM_IO, "%s: %s", item->from, strerror(errno));
    if (count > 0 || fflush(to) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    return FM_OK;
}

static fm_status copy_item(bundle_item *item, const char *root, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    FILE *from = NULL, *to = NULL;
    fm_status status = path_join(path, root, item->to, err);
    if (status == FM_OK)
        status = make_folders(path, strlen(root), err);
    if (status != FM_OK)
        return status;
    from = fopen(item->from, "rb");
    if (from == NULL)
        return fm_fail(err, FM_IO, "%s: %s", item->from, strerror(errno));
    to = fopen(path, "wb");
    status = to != NULL ? copy_bytes(item, from, to, path, err)
                        : fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    if (to != NULL && fclose(to) != 0 && status == FM_OK)
        status = fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    fclose(from);
    if (status == FM_OK && chmod(path, item->is_program ? 0755 : 0644) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    return status;
}

fm_status items_copy(bundle_items *items, const char *root, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < items->count && status == FM_OK; i++)
        status = copy_item(&items->items[i], root, err);
    return status;
}

void items_free(bundle_items *items)
{
    for (size_t i = 0; i < items->count; i++) {
        free(items->items[i].from);
        free(items->items[i].to);
    }
    free(items->items);
    text_index_free(&items->index);
    *items = (bundle_items){ 0 };
}

void tree_remove(const char *root)
{
    char path[FM_PATH_MAX_BYTES];
    snprintf(path, sizeof path, "%s", root);
    FTS *walk = fts_open((char *const[]){ path, NULL }, FTS_PHYSICAL | FTS_NOCHDIR, NULL);
    for (FTSENT *entry; walk != NULL && (entry = fts_read(walk)) != NULL;) {
        if (entry->fts_info == FTS_DP)
            rmdir(entry->fts_path);
        else if (entry->fts_info != FTS_D)
            unlink(entry->fts_path);
    }
    if (walk != NULL)
        fts_close(walk);
}
