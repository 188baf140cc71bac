#include "yaml_fields.h"

#include <stdio.h>
#include <string.h>

/* `unknown`: what is wrong, in words. */
static fm_status fail_nearest(const fm_yaml_place *at, uint32_t line, const char *unknown,
                              const char *nearest)
{
    return fm_fail(at->err, FM_INVALID, "%s:%u: unknown %s%s%s%s", at->path, line, unknown,
                   nearest == NULL ? "" : "; is \"", nearest == NULL ? "" : nearest,
                   nearest == NULL ? "" : "\" meant?");
}

fm_status field_check_keys(const fm_yaml *map, const char *what, const char *const *keys,
                           size_t key_count, const fm_yaml_place *at)
{
    char unknown[160];
    if (map->kind != FM_YAML_MAP)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: keys and values are expected", at->path,
                       map->line, what);
    for (size_t i = 0; i < map->count; i++) {
        const fm_yaml *item = &map->items[i];
        bool known = false;
        for (size_t j = 0; j < key_count && !known; j++)
            known = strcmp(item->key, keys[j]) == 0;
        if (known)
            continue;
        snprintf(unknown, sizeof unknown, "key \"%.80s\" of %.60s", item->key, what);
        return fail_nearest(at, item->line, unknown, text_nearest(item->key, keys, key_count));
    }
    return FM_OK;
}

fm_status field_text(const char **text, const fm_yaml *map, const char *key, bool needed,
                     const fm_yaml_place *at)
{
    const fm_yaml *value = yaml_tree_find(map, key);
    *text = value == NULL || value->text == NULL ? "" : value->text;
    if (value != NULL && value->kind != FM_YAML_SCALAR)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a text is expected", at->path, value->line,
                       key);
    if (needed && (*text)[0] == '\0')
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s is missing", at->path, map->line, key);
    return FM_OK;
}

fm_status field_number(double *value, const fm_yaml *map, const char *key, const fm_yaml_place *at)
{
    const fm_yaml *found = yaml_tree_find(map, key);
    if (found == NULL)
        return FM_OK;
    if (found->kind != FM_YAML_SCALAR || !text_to_double(value, found->text))
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a number is expected", at->path,
                       found->line, key);
    return FM_OK;
}

fm_status field_whole(uint64_t *value, const fm_yaml *map, const char *key, uint64_t most,
                      const fm_yaml_place *at)
{
    const fm_yaml *found = yaml_tree_find(map, key);
    if (found == NULL || found->kind != FM_YAML_SCALAR || !text_to_u64(value, found->text) ||
        *value > most)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a whole number up to %llu is expected",
                       at->path, found != NULL ? found->line : map->line, key,
                       (unsigned long long)most);
    return FM_OK;
}

fm_status field_items(const fm_yaml **list, const fm_yaml *map, const char *key,
                      const fm_yaml_place *at)
{
    *list = yaml_tree_find(map, key);
    if (*list != NULL && (*list)->kind == FM_YAML_LIST)
        return FM_OK;
    return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a list is expected", at->path,
                   *list != NULL ? (*list)->line : map->line, key);
}

static fm_status add_text(fm_text_list *list, const fm_yaml *value, const char *key,
                          const fm_yaml_place *at)
{
    if (value->kind != FM_YAML_SCALAR)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a text is expected", at->path, value->line,
                       key);
    if (!text_list_add(list, value->text))
        return fm_fail(at->err, FM_NO_MEMORY, "%s:%u: %s", at->path, value->line, key);
    return FM_OK;
}

fm_status field_list(fm_text_list *list, const fm_yaml *map, const char *key,
                     const fm_yaml_place *at)
{
    const fm_yaml *value = yaml_tree_find(map, key);
    fm_status status = FM_OK;
    if (value == NULL)
        return FM_OK;
    if (value->kind == FM_YAML_SCALAR)
        return add_text(list, value, key, at);
    if (value->kind != FM_YAML_LIST)
        return fm_fail(at->err, FM_INVALID, "%s:%u: %s: a list of texts is expected", at->path,
                       value->line, key);
    for (size_t i = 0; i < value->count && status == FM_OK; i++)
        status = add_text(list, &value->items[i], key, at);
    return status;
}

fm_status field_word(int *index, const fm_yaml *map, const char *key, const char *const *words,
                     size_t word_count, const fm_yaml_place *at)
{
    char unknown[160];
    const char *text;
    const fm_status status = field_text(&text, map, key, false, at);
    *index = 0;
    if (status != FM_OK || text[0] == '\0')
        return status;
    for (size_t i = 0; i < word_count; i++)
        if (strcmp(words[i], text) == 0) {
            *index = (int)i;
            return FM_OK;
        }
    snprintf(unknown, sizeof unknown, "%.60s \"%.80s\"", key, text);
    return fail_nearest(at, yaml_tree_find(map, key)->line, unknown,
                        text_nearest(text, words, word_count));
}

fm_status field_bool(bool *value, const fm_yaml *map, const char *key, const fm_yaml_place *at)
{
    static const char *const words[] = { "false", "true" };
    int index;
    const fm_status status = field_word(&index, map, key, words, 2, at);
    *value = index == 1;
    return status;
}
