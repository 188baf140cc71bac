#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "base/text.h"
#include "model/feeds.h"
#include "plugin.h"

typedef char path_text[2 * FM_PATH_MAX_BYTES];

static bool join(path_text path, const char *folder, const char *name)
{
    const int length = snprintf(path, sizeof(path_text), "%s/%s", folder, name);
    return length > 0 && (size_t)length < FM_PATH_MAX_BYTES;
}

static fm_status add_entry(fm_plugin_list *list, const char *id, const char *path, fm_error *err)
{
    fm_plugin_entry *grown = realloc(list->entries, (list->count + 1) * sizeof *list->entries);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "list of plugins");
    list->entries = grown;
    fm_plugin_entry *entry = &grown[list->count++];
    *entry = (fm_plugin_entry){ 0 };
    snprintf(entry->id, sizeof entry->id, "%s", id);
    memcpy(entry->path, path, strlen(path) + 1); /* join() has seen to its length */
    return FM_OK;
}

/* Whether folder/id/id.so is there, whatever it is. */
static bool find_object(path_text path, const char *folder, const char *id)
{
    path_text file;
    if (id[0] == '.' || strlen(id) >= sizeof((fm_plugin_entry *)0)->id)
        return false;
    snprintf(file, sizeof file, "%s/%s.so", id, id);
    return join(path, folder, file) && faccessat(AT_FDCWD, path, F_OK, AT_SYMLINK_NOFOLLOW) == 0;
}

/* Takes folder/id/id.so, unless there is none, or an earlier folder had it. A link that leads
 * nowhere is there. */
static fm_status scan_entry(fm_plugin_list *list, const char *folder, const char *id, fm_error *err)
{
    path_text path;
    if (plugin_list_find(list, id) != NULL || !find_object(path, folder, id))
        return FM_OK;
    return add_entry(list, id, path, err);
}

/* What is done with each folder. */
typedef fm_status folder_visit(fm_plugin_list *list, const char *folder, fm_error *err);

/* The first folder that has the runner's GLSL. */
static fm_status note_common(fm_plugin_list *list, const char *folder, fm_error *err)
{
    path_text common, prelude;
    (void)err;
    if (list->common_folder[0] == '\0' && join(common, folder, "common") &&
        join(prelude, common, "prelude.glsl") && access(prelude, R_OK) == 0)
        memcpy(list->common_folder, common, strlen(common) + 1);
    return FM_OK;
}

static fm_status scan_folder(fm_plugin_list *list, const char *folder, fm_error *err)
{
    fm_status status = FM_OK;
    struct dirent **names = NULL;
    const int count = scandir(folder, &names, NULL, alphasort);
    if (count < 0)
        return fm_fail(err, FM_IO, "plugin folder %s: %s", folder,
                       errno == ENOTDIR ? "is not a folder" : strerror(errno));
    for (int i = 0; i < count; i++) {
        if (status == FM_OK)
            status = scan_entry(list, folder, names[i]->d_name, err);
        free(names[i]);
    }
    free(names);
    return status;
}

static int compare_entries(const void *left, const void *right)
{
    return strcmp(((const fm_plugin_entry *)left)->id, ((const fm_plugin_entry *)right)->id);
}

static int is_method_folder(const struct dirent *name)
{
    return name->d_name[0] != '.';
}

/* A folder that was named and gives nothing is a mistake: it would measure what is built in. */
static fm_status expect_plugins(const char *folder, fm_error *err)
{
    struct dirent **names = NULL;
    bool is_found = false;
    path_text path;
    const int count = scandir(folder, &names, is_method_folder, NULL);
    for (int i = 0; i < count; i++) {
        is_found = is_found || find_object(path, folder, names[i]->d_name) ||
                   strcmp(names[i]->d_name, "common") == 0;
        free(names[i]);
    }
    free(names);
    return is_found || count < 0
               ? FM_OK
               : fm_fail(err, FM_INVALID, "plugin folder %s: no plugin lies there as ID/ID.so",
                         folder);
}

static fm_status visit_folders(fm_plugin_list *list, const char *const *extra, folder_visit *visit,
                               fm_error *err)
{
    fm_text_list folders = { 0 };
    fm_status status = FM_OK;
    for (; extra != NULL && *extra != NULL && status == FM_OK; extra++) {
        status = visit(list, *extra, err);
        if (status == FM_OK)
            status = expect_plugins(*extra, err);
    }
    if (status == FM_OK)
        status = data_folders(&folders, DATA_METHODS, err);
    for (size_t i = 0; i < folders.count && status == FM_OK; i++)
        status = visit(list, folders.items[i], err);
    text_list_free(&folders);
    return status;
}

fm_status plugin_list_open(fm_plugin_list *list, const char *const *extra, fm_error *err)
{
    fm_error ignored;
    if (err == NULL)
        err = &ignored;
    *list = (fm_plugin_list){ 0 };
    /* Plugins of an earlier folder may use shaders of methods in a later one. */
    fm_status status = visit_folders(list, extra, note_common, err);
    if (status == FM_OK)
        status = visit_folders(list, extra, scan_folder, err);
    if (status != FM_OK) {
        plugin_list_close(list);
        return status;
    }
    if (list->count > 0)
        qsort(list->entries, list->count, sizeof *list->entries, compare_entries);
    return FM_OK;
}

void plugin_list_close(fm_plugin_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        plugin_close(list->entries[i].plugin);
    free(list->entries);
    *list = (fm_plugin_list){ 0 };
}

fm_plugin_entry *plugin_list_find(const fm_plugin_list *list, const char *id)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->entries[i].id, id) == 0)
            return &list->entries[i];
    return NULL;
}

bool plugin_entry_is_refused(const fm_plugin_entry *entry)
{
    return entry->plugin == NULL && entry->error.status != FM_OK;
}

fm_status plugin_load_entries(const fm_plugin_list *list, fm_plugin_entry *const *entries,
                              size_t count, fm_error *err)
{
    (void)err;
    for (size_t i = 0; i < count; i++) /* a refusal stays in the entry */
        (void)plugin_open(&entries[i]->plugin, entries[i]->path, list->common_folder,
                          &entries[i]->error);
    return FM_OK;
}

fm_status plugin_list_read(const fm_plugin_list *list, fm_plugin_entry *const *entries,
                           size_t count, fm_error *err)
{
    fm_plugin_reader *reader = list->reader != NULL ? list->reader : plugin_load_entries;
    fm_plugin_entry **unread = calloc(count + 1, sizeof *unread);
    size_t unread_count = 0;
    if (unread == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu plugins", count);
    for (size_t i = 0; i < count; i++)
        if (entries[i]->plugin == NULL && !plugin_entry_is_refused(entries[i]))
            unread[unread_count++] = entries[i];
    const fm_status status = unread_count > 0 ? reader(list, unread, unread_count, err) : FM_OK;
    free(unread);
    return status;
}

fm_status plugin_list_read_all(const fm_plugin_list *list, fm_error *err)
{
    fm_plugin_entry **all = calloc(list->count + 1, sizeof *all);
    if (all == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu plugins", list->count);
    for (size_t i = 0; i < list->count; i++)
        all[i] = &list->entries[i];
    const fm_status status = plugin_list_read(list, all, list->count, err);
    free(all);
    return status;
}

fm_status plugin_list_get(fm_plugin_entry **entry, const fm_plugin_list *list, const char *id,
                          fm_error *err)
{
    *entry = plugin_list_find(list, id);
    if (*entry != NULL)
        return FM_OK;
    const char **ids = calloc(list->count + 1, sizeof *ids);
    if (ids == NULL)
        return fm_fail(err, FM_NO_MEMORY, "method '%s'", id);
    for (size_t i = 0; i < list->count; i++)
        ids[i] = list->entries[i].id;
    const char *nearest = text_nearest(id, ids, list->count);
    free(ids);
    if (nearest == NULL)
        return fm_fail(err, FM_INVALID, "method '%s': no such plugin among %zu", id, list->count);
    return fm_fail(err, FM_INVALID, "method '%s': no such plugin; nearest is '%s'", id, nearest);
}

static bool is_floor(const fm_plugin_entry *entry, uint32_t feed)
{
    return entry->plugin != NULL && (entry->plugin->method->traits & FM_TRAIT_FLOOR) != 0 &&
           (method_feeds(entry->plugin->method) & feed) != 0;
}

fm_status plugin_list_floor(const fm_plugin **plugin, const fm_plugin_list *list, uint32_t feed,
                            fm_error *err)
{
    fm_plugin_entry *usual = plugin_list_find(list, feed_info(feed)->floor);
    fm_status status = FM_OK;
    *plugin = NULL;
    if (usual != NULL)
        status = plugin_list_read(list, &usual, 1, err);
    if (status == FM_OK && (usual == NULL || !is_floor(usual, feed)))
        status = plugin_list_read_all(list, err);
    if (status != FM_OK)
        return status;
    if (usual != NULL && is_floor(usual, feed))
        *plugin = usual->plugin;
    for (size_t i = 0; i < list->count && *plugin == NULL; i++)
        if (is_floor(&list->entries[i], feed))
            *plugin = list->entries[i].plugin;
    if (*plugin == NULL)
        return fm_fail(err, FM_INVALID, "no plugin is the floor of feed %s: is '%s' built?",
                       feed_name(feed), feed_info(feed)->floor);
    return FM_OK;
}
