#include "bundle_methods.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "model/feeds.h"

static const char *const glsl[] = { ".glsl", NULL };

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the names of methods");
}

static bool is_wanted(const fm_bundle_desc *desc, const char *id)
{
    if (desc->methods == NULL || desc->methods->count == 0 || text_list_has(desc->methods, id))
        return true;
    for (size_t i = 0; i < FM_FEED_COUNT; i++)
        if (strcmp(fm_feeds[i].floor, id) == 0)
            return true;
    return false;
}

static fm_status add_plugin(bundle_items *items, fm_text_list *ids, fm_text_list *plugins,
                            const char *path, const char *id, fm_error *err)
{
    char to[FM_PATH_MAX_BYTES], file[FM_PATH_MAX_BYTES];
    snprintf(file, sizeof file, "%s/%s.so", id, id);
    const fm_status status = path_join(to, data_bundle_folder(DATA_METHODS), file, err);
    if (status != FM_OK)
        return status;
    if (!text_list_add(ids, id) || !text_list_add(plugins, path))
        return no_memory(err);
    return items_add(items, path, to, err);
}

/* What the list shares, and adds to, while folders are walked. */
typedef struct gathering {
    bundle_items *items;
    fm_text_list *ids, *plugins, known; /* known: all ids that there are */
    const fm_bundle_desc *desc;
} gathering;

/* FOLDER/ID with its GLSL, and ID.so if it is wanted; FOLDER/common has GLSL alone. */
static fm_status add_entry(gathering *all, const char *folder, const char *id, fm_error *err)
{
    char from[FM_PATH_MAX_BYTES], to[FM_PATH_MAX_BYTES], file[FM_PATH_MAX_BYTES];
    char plugin[FM_PATH_MAX_BYTES];
    uint32_t ignored = 0;
    snprintf(file, sizeof file, "%s/%s.so", id, id);
    fm_status status = path_join(from, folder, id, err);
    if (status == FM_OK)
        status = path_join(plugin, folder, file, err);
    if (status == FM_OK)
        status = path_join(to, data_bundle_folder(DATA_METHODS), id, err);
    const bool is_plugin = status == FM_OK && access(plugin, F_OK) == 0;
    if (status != FM_OK || (!is_plugin && strcmp(id, "common") != 0) ||
        text_list_has(&all->known, id))
        return status;
    if (!text_list_add(&all->known, id))
        return no_memory(err);
    status = items_add_tree(all->items, &ignored, from, to, glsl, err);
    if (status == FM_OK && is_plugin && is_wanted(all->desc, id))
        status = add_plugin(all->items, all->ids, all->plugins, plugin, id, err);
    return status;
}

static fm_status add_folder(gathering *all, const char *folder, fm_error *err)
{
    struct dirent **names = NULL;
    fm_status status = path_is_folder(folder, err);
    const int count = status == FM_OK ? scandir(folder, &names, NULL, alphasort) : 0;
    if (count < 0)
        return fm_fail(err, FM_IO, "%s: %s", folder, strerror(errno));
    for (int i = 0; i < count; i++) {
        if (status == FM_OK && names[i]->d_name[0] != '.')
            status = add_entry(all, folder, names[i]->d_name, err);
        free(names[i]);
    }
    free(names);
    return status;
}

static fm_status check_names(const gathering *all, fm_error *err)
{
    const fm_text_list *wanted = all->desc->methods;
    if (all->ids->count == 0 && (wanted == NULL || wanted->count == 0))
        return fm_fail(err, FM_INVALID,
                       "no method was found; FRAGMARK_PLUGIN_PATH or "
                       "--plugin-dir name their folder");
    for (size_t i = 0; wanted != NULL && i < wanted->count; i++) {
        const char *nearest =
            text_nearest(wanted->items[i], text_list_items(&all->known), all->known.count);
        if (!text_list_has(all->ids, wanted->items[i]))
            return fm_fail(err, FM_INVALID, "no method '%.100s'%s%s%s", wanted->items[i],
                           nearest != NULL ? "; the nearest is '" : "",
                           nearest != NULL ? nearest : "", nearest != NULL ? "'" : "");
    }
    return FM_OK;
}

fm_status bundle_add_methods(bundle_items *items, fm_text_list *ids, fm_text_list *plugins,
                             const fm_bundle_desc *desc, fm_error *err)
{
    fm_text_list folders = { 0 };
    gathering all = { .items = items, .ids = ids, .plugins = plugins, .desc = desc };
    fm_status status = text_list_add_all(&folders, desc->plugin_folders) ? FM_OK : no_memory(err);
    if (status == FM_OK)
        status = data_folders(&folders, DATA_METHODS, err);
    for (size_t i = 0; i < folders.count && status == FM_OK; i++)
        status = add_folder(&all, folders.items[i], err);
    if (status == FM_OK)
        status = check_names(&all, err);
    text_list_free(&all.known);
    text_list_free(&folders);
    return status;
}
