#include <dirent.h>
#include <stdlib.h>
#include <string.h>

#include "base/data.h"
#include "cli.h"
#include "model/figure_file.h"

static int compare_ids(const void *left, const void *right)
{
    const fm_figure *a = left, *b = right;
    return strcmp(a->id, b->id);
}

static bool has_figure(const fm_figure_list *list, const char *id)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->figures[i].id, id) == 0)
            return true;
    return false;
}

/* A figure whose file is damaged is listed too: reproducing it says what is wrong. */
static void read_head(fm_figure *figure)
{
    fm_figure_file file;
    fm_error ignored = { 0 };
    figure_file_read(&file, figure->path, &ignored);
    snprintf(figure->title, sizeof figure->title, "%s", file.title);
    figure->has_pictures = file.keeps_pictures;
    figure_file_close(&file);
}

fm_status figure_add_claims(fm_text_list *names, const fm_figure *figure, fm_error *err)
{
    fm_figure_file file;
    fm_error ignored = { 0 };
    fm_status status = FM_OK;
    figure_file_read(&file, figure->path, &ignored);
    for (size_t i = 0; file.claims != NULL && i < file.claims->count && status == FM_OK; i++) {
        const fm_yaml *id = yaml_tree_find(&file.claims->items[i], "id");
        if (id != NULL && id->text != NULL)
            status = names_add(names, id->text, err);
    }
    figure_file_close(&file);
    return status;
}

bool figure_has_claim(const fm_figure *figure, const char *claim)
{
    fm_text_list ids = { 0 };
    fm_error below = { 0 };
    bool is_found = false;
    figure_add_claims(&ids, figure, &below);
    for (size_t i = 0; i < ids.count && !is_found; i++)
        is_found = strcmp(ids.items[i], claim) == 0;
    text_list_free(&ids);
    return is_found;
}

static fm_status add_figure(fm_figure_list *list, const char *folder, const char *file,
                            fm_error *err)
{
    fm_figure figure = { 0 };
    const char *ending = strrchr(file, '.');
    if (ending == NULL || strcmp(ending, ".yml") != 0 || file[0] == '.' ||
        (size_t)(ending - file) >= sizeof figure.id)
        return FM_OK;
    snprintf(figure.id, sizeof figure.id, "%.*s", (int)(ending - file), file);
    const int length = snprintf(figure.path, sizeof figure.path, "%s/%s", folder, file);
    if (length < 0 || (size_t)length >= sizeof figure.path || has_figure(list, figure.id))
        return FM_OK;
    read_head(&figure);
    fm_figure *grown = reallocarray(list->figures, list->count + 1, sizeof *grown);
    if (grown == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu figures", list->count + 1);
    list->figures = grown;
    grown[list->count++] = figure;
    return FM_OK;
}

static fm_status add_folder(fm_figure_list *list, const char *folder, fm_error *err)
{
    fm_status status = FM_OK;
    DIR *files = opendir(folder);
    const struct dirent *file;
    while (files != NULL && status == FM_OK && (file = readdir(files)) != NULL)
        status = add_figure(list, folder, file->d_name, err);
    if (files != NULL)
        closedir(files);
    return status;
}

fm_status figures_list(fm_figure_list *list, fm_error *err)
{
    fm_text_list folders = { 0 };
    *list = (fm_figure_list){ 0 };
    fm_status status = data_folders(&folders, DATA_FIGURES, err);
    for (size_t i = 0; i < folders.count && status == FM_OK; i++)
        status = add_folder(list, folders.items[i], err);
    text_list_free(&folders);
    if (status == FM_OK && list->count > 0)
        qsort(list->figures, list->count, sizeof *list->figures, compare_ids);
    else
        figures_free(list);
    return status;
}

void figures_free(fm_figure_list *list)
{
    free(list->figures);
    *list = (fm_figure_list){ 0 };
}

static json_t *tree_json(const fm_yaml *tree)
{
    json_t *json = NULL;
    switch (tree->kind) {
    case FM_YAML_SCALAR:
        return json_string(tree->text);
    case FM_YAML_LIST:
        json = json_array();
        for (size_t i = 0; i < tree->count; i++)
            json_array_append_new(json, tree_json(&tree->items[i]));
        return json;
    case FM_YAML_MAP:
        json = json_object();
        for (size_t i = 0; i < tree->count; i++)
            json_object_set_new(json, tree->items[i].key, tree_json(&tree->items[i]));
        return json;
    }
    return NULL;
}

/* n and r say the same thing in two ways: whoever sets one takes the other away. */
static bool is_replaced(const fm_yaml *smoke, const char *key)
{
    if (yaml_tree_find(smoke, key) != NULL)
        return true;
    return (strcmp(key, "n") == 0 && yaml_tree_find(smoke, "r") != NULL) ||
           (strcmp(key, "r") == 0 && yaml_tree_find(smoke, "n") != NULL);
}

/* One line a key; its value as JSON, which YAML takes. */
static void add_keys(fm_text *text, const fm_yaml *map, const fm_yaml *without)
{
    for (size_t i = 0; map != NULL && i < map->count; i++) {
        if (without != NULL && is_replaced(without, map->items[i].key))
            continue;
        json_t *value = tree_json(&map->items[i]);
        char *line = value != NULL ? json_dumps(value, JSON_ENCODE_ANY) : NULL;
        if (line == NULL)
            text->failed = true;
        else
            text_add(text, "%s: %s\n", map->items[i].key, line);
        free(line);
        json_decref(value);
    }
}

static fm_status require_map(const fm_yaml *tree, const char *key, const char *path, fm_error *err)
{
    if (tree == NULL || tree->kind == FM_YAML_MAP)
        return FM_OK;
    return fm_fail(err, FM_INVALID, "%s:%u: '%s': a mapping is expected", path, tree->line, key);
}

/* One block as a spec file. */
static fm_status write_spec(const char *path, const fm_figure *figure, const fm_yaml *block,
                            const fm_yaml *smoke, fm_error *err)
{
    fm_text text = { 0 };
    fm_status status = require_map(block, "run", figure->path, err);
    if (status != FM_OK)
        return status;
    text_add(&text, "# %s%s\n", figure->id, smoke != NULL ? ", smoke" : "");
    add_keys(&text, block, smoke);
    add_keys(&text, smoke, NULL);
    status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                         : text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}

/* The blocks under one key: a mapping is one block. */
static fm_status write_blocks(fm_text_list *paths, const char *folder, const fm_figure *figure,
                              const fm_yaml *blocks, const fm_yaml *smoke, fm_error *err)
{
    char path[2 * FM_PATH_MAX_BYTES];
    const bool is_list = blocks != NULL && blocks->kind == FM_YAML_LIST;
    const size_t count = is_list ? blocks->count : blocks != NULL;
    fm_status status = FM_OK;
    for (size_t i = 0; i < count && status == FM_OK; i++) {
        const fm_yaml *block = is_list ? &blocks->items[i] : blocks;
        snprintf(path, sizeof path, "%s/%s-run%zu.yml", folder, figure->id, paths->count + 1);
        status = write_spec(path, figure, block, smoke, err);
        if (status == FM_OK)
            status = names_add(paths, path, err);
    }
    return status;
}

fm_status figure_write_specs(fm_text_list *paths, const char *folder, const fm_figure *figure,
                             fm_figure_size size, fm_error *err)
{
    fm_figure_file file;
    fm_status status = figure_file_read(&file, figure->path, err);
    const fm_yaml *smoke = size == FM_FIGURE_SMOKE ? file.smoke : NULL;
    if (status == FM_OK)
        status = require_map(smoke, "smoke", figure->path, err);
    if (status == FM_OK && file.run == NULL)
        status = fm_fail(err, FM_UNSUPPORTED, "%s: has no 'run': nothing to measure", figure->path);
    if (status == FM_OK)
        status = write_blocks(paths, folder, figure, file.run, smoke, err);
    if (status == FM_OK && size == FM_FIGURE_LARGE)
        status = write_blocks(paths, folder, figure, file.large, NULL, err);
    figure_file_close(&file);
    return status;
}
