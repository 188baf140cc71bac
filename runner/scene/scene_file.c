#include "scene_file.h"

#include <fts.h>
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "base/file.h"
#include "base/path.h"
#include "base/text.h"

/* Texts for people; no settings. */
static const char *const described[] = { "title",        "source", "checksum", "licence",
                                         "stand_in_for", "why",    "answer" };
enum { DESCRIBED_COUNT = sizeof described / sizeof described[0] };

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the names of scenes");
}

static bool is_yaml_name(const char *name)
{
    const size_t length = strlen(name);
    return length > 4 && strcmp(name + length - 4, ".yml") == 0;
}

/* Adds path as the scene `name`, unless an earlier folder had it. */
static fm_status add_scene(fm_scene_names *names, const char *name, size_t name_length,
                           const char *path, fm_error *err)
{
    if (name_length >= sizeof names->names[0] || strlen(path) >= sizeof names->paths[0])
        return FM_OK; /* too long to be asked for */
    for (size_t i = 0; i < names->count; i++)
        if (strlen(names->names[i]) == name_length &&
            strncmp(names->names[i], name, name_length) == 0)
            return FM_OK;
    void *grown = realloc(names->names, (names->count + 2) * sizeof names->names[0]);
    if (grown == NULL)
        return no_memory(err);
    names->names = grown;
    grown = realloc(names->paths, (names->count + 2) * sizeof names->paths[0]);
    if (grown == NULL)
        return no_memory(err);
    names->paths = grown;
    memset(&names->names[names->count], 0, 2 * sizeof names->names[0]);
    memset(&names->paths[names->count], 0, 2 * sizeof names->paths[0]);
    memcpy(names->names[names->count], name, name_length);
    strcpy(names->paths[names->count], path);
    names->count++;
    return FM_OK;
}

static int by_name(const FTSENT **a, const FTSENT **b)
{
    return strcmp((*a)->fts_name, (*b)->fts_name);
}

/* The folder's scenes and those one folder below: "layers", "hard/ulp". */
static fm_status list_folder(fm_scene_names *names, char *folder, fm_error *err)
{
    fm_status status = FM_OK;
    char *const roots[] = { folder, NULL };
    const size_t skipped = strlen(folder);
    FTS *walk = fts_open(roots, FTS_PHYSICAL | FTS_COMFOLLOW | FTS_NOCHDIR, by_name);
    if (walk == NULL)
        return no_memory(err);
    for (FTSENT *entry; status == FM_OK && (entry = fts_read(walk)) != NULL;) {
        const bool is_file = entry->fts_info == FTS_F || entry->fts_info == FTS_SL;
        if (entry->fts_info == FTS_D && entry->fts_level >= 2)
            fts_set(walk, entry, FTS_SKIP);
        if (!is_file || entry->fts_level < 1 || !is_yaml_name(entry->fts_name))
            continue;
        const char *name = entry->fts_path + skipped;
        name += strspn(name, "/");
        status = add_scene(names, name, strlen(name) - 4, entry->fts_path, err);
    }
    fts_close(walk);
    return status;
}

fm_status scene_names_list(fm_scene_names *names, fm_error *err)
{
    fm_text_list folders = { 0 };
    *names = (fm_scene_names){ 0 };
    fm_status status = data_folders(&folders, DATA_SCENES, err);
    for (size_t i = 0; status == FM_OK && i < folders.count; i++)
        status = list_folder(names, folders.items[i], err);
    text_list_free(&folders);
    if (status != FM_OK)
        scene_names_free(names);
    return status;
}

void scene_names_free(fm_scene_names *names)
{
    free(names->names);
    free(names->paths);
    *names = (fm_scene_names){ 0 };
}

static fm_status unknown_scene(const char *name, const fm_scene_names *names, fm_error *err)
{
    const char **known = calloc(names->count + 1, sizeof *known);
    if (known == NULL)
        return no_memory(err);
    for (size_t i = 0; i < names->count; i++)
        known[i] = names->names[i];
    const char *nearest = text_nearest(name, known, names->count);
    free(known);
    if (names->count == 0)
        return fm_fail(err, FM_INVALID,
                       "no scene '%.200s': no scene folder found; set FRAGMARK_SCENE_PATH", name);
    return fm_fail(err, FM_INVALID, "no scene '%.200s'%s%s%s", name,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "; `list scenes` shows all");
}

fm_status scene_file_find(char path[FM_PATH_MAX_BYTES], const char *name, fm_error *err)
{
    fm_scene_names names = { 0 };
    if (is_yaml_name(name)) {
        if (!path_beside(path, FM_PATH_MAX_BYTES, "", name))
            return fm_fail(err, FM_INVALID, "scene '%.200s...': too long a path", name);
        return FM_OK;
    }
    fm_status status = scene_names_list(&names, err);
    if (status != FM_OK)
        return status;
    status = FM_INVALID;
    for (size_t i = 0; i < names.count && status != FM_OK; i++) {
        if (strcmp(names.names[i], name) == 0) {
            strcpy(path, names.paths[i]);
            status = FM_OK;
        }
    }
    if (status != FM_OK)
        status = unknown_scene(name, &names, err);
    scene_names_free(&names);
    return status;
}

static fm_status join_vector(char text[FM_PATH_MAX_BYTES], const fm_yaml *value)
{
    int length = 0;
    for (size_t i = 0; i < value->count; i++) {
        if (value->items[i].kind != FM_YAML_SCALAR)
            return FM_INVALID;
        length += snprintf(text + length, (size_t)(FM_PATH_MAX_BYTES - length), "%s%s",
                           i > 0 ? " " : "", value->items[i].text);
        if (length >= FM_PATH_MAX_BYTES)
            return FM_INVALID;
    }
    return FM_OK;
}

fm_status scene_file_value(char text[FM_PATH_MAX_BYTES], const fm_key *key, const fm_yaml *value,
                           const char *file, fm_error *err)
{
    text[0] = '\0';
    if (value->kind == FM_YAML_LIST && key->type == FM_KEY_VECTOR) {
        if (join_vector(text, value) == FM_OK)
            return FM_OK;
    } else if (value->kind == FM_YAML_SCALAR && key->type == FM_KEY_TEXT &&
               key->scope == FM_SCOPE_SCENE && value->text[0] != '\0') {
        if (path_beside(text, FM_PATH_MAX_BYTES, file, value->text))
            return FM_OK;
    } else if (value->kind == FM_YAML_SCALAR) {
        if (path_beside(text, FM_PATH_MAX_BYTES, "", value->text))
            return FM_OK;
    }
    return fm_fail(err, FM_INVALID, "%s:%u: %s: not one value", file, value->line, key->name);
}

/* Of what describes a scene and of the keys. */
static const char *nearest_name(const char *name)
{
    const char *nearest[] = { text_nearest(name, described, DESCRIBED_COUNT), key_nearest(name) };
    if (nearest[0] == NULL || nearest[1] == NULL)
        return nearest[nearest[0] == NULL];
    return text_nearest(name, nearest, 2);
}

static fm_status unknown_key(const char *path, const fm_yaml *item, fm_error *err)
{
    const char *nearest = nearest_name(item->key);
    return fm_fail(err, FM_INVALID, "%s:%u: no key '%.200s'%s%s%s", path, item->line, item->key,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "");
}

static bool is_described(const char *name)
{
    for (size_t i = 0; i < DESCRIBED_COUNT; i++)
        if (strcmp(described[i], name) == 0)
            return true;
    return false;
}

static fm_status apply_item(fm_settings *settings, const fm_yaml *item, const char *path,
                            fm_error *err)
{
    char text[FM_PATH_MAX_BYTES];
    const fm_key *key = key_find(item->key);
    if (is_described(item->key)) {
        if (item->kind != FM_YAML_SCALAR)
            return fm_fail(err, FM_INVALID, "%s:%u: %s: not a text", path, item->line, item->key);
        return FM_OK;
    }
    if (key == NULL)
        return unknown_key(path, item, err);
    if (key->scope != FM_SCOPE_SCENE)
        return fm_fail(err, FM_INVALID, "%s:%u: '%s' is no key of a scene; give it with -a", path,
                       item->line, item->key);
    const fm_status status = scene_file_value(text, key, item, path, err);
    if (status != FM_OK)
        return status;
    if (settings_set(settings, key, text, err) != FM_OK)
        return fm_error_prefix(err, "%s:%u", path, item->line);
    return FM_OK;
}

/* What can be judged only when the whole file is known. */
static fm_status check_items(const fm_settings *settings, const fm_yaml *root, const char *path,
                             fm_error *err)
{
    const fm_yaml *n = yaml_tree_find(root, "n"), *r = yaml_tree_find(root, "r");
    if (n != NULL && r != NULL)
        return fm_fail(err, FM_INVALID, "%s:%u: n and r: give one of them", path, r->line);
    for (size_t i = 0; i < root->count; i++) {
        const fm_key *key = key_find(root->items[i].key);
        if (key != NULL && !key_is_read(key, settings->generator))
            return fm_fail(err, FM_INVALID, "%s:%u: '%s' is not read by generator %s", path,
                           root->items[i].line, key->name,
                           key_find("generator")->values[settings->generator]);
    }
    return FM_OK;
}

fm_status scene_file_read(fm_settings *settings, const char *path, fm_error *err)
{
    fm_error own;
    fm_yaml *root = NULL;
    fm_settings read;
    if (err == NULL)
        err = &own;
    settings_default(&read);
    fm_status status = yaml_tree_read(&root, path, err);
    if (status != FM_OK)
        return status;
    if (root->kind != FM_YAML_MAP)
        status = fm_fail(err, FM_INVALID, "%s:%u: not 'key: value' lines", path, root->line);
    for (size_t i = 0; status == FM_OK && i < root->count; i++)
        status = apply_item(&read, &root->items[i], path, err);
    if (status == FM_OK)
        status = check_items(&read, root, path, err);
    if (status == FM_OK)
        *settings = read;
    yaml_tree_free(root);
    return status;
}
