#include "options.h"

#include <stdio.h>
#include <string.h>

#include "model/settings.h"

/* "key=value" within the text. */
typedef struct pair {
    const char *text;
    size_t key_length, length;
} pair;

/* Takes the next pair off the text; false: there is none. */
static bool next_pair(pair *next, const char **options)
{
    *options += strspn(*options, " ");
    *next = (pair){ .text = *options,
                    .key_length = strcspn(*options, "= "),
                    .length = strcspn(*options, " ") };
    *options += next->length;
    return next->length > 0;
}

static bool is_wanted(const pair *one, fm_options_sort sort, const fm_text_list *without)
{
    char name[64];
    snprintf(name, sizeof name, "%.*s", (int)one->key_length, one->text);
    const fm_key *key = key_find(name);
    const bool is_of_scene = key != NULL && (key->scope == FM_SCOPE_SCENE || key->is_of_picture);
    return is_of_scene == (sort == FM_OPTIONS_OF_SCENE) && !text_list_has(without, name);
}

static bool next_wanted(pair *next, const char **options, fm_options_sort sort,
                        const fm_text_list *without)
{
    while (next_pair(next, options))
        if (is_wanted(next, sort, without))
            return true;
    return false;
}

void options_value(char value[FM_OPTION_VALUE_BYTES], const char *options, const char *key)
{
    pair one;
    const size_t length = strlen(key);
    value[0] = '\0';
    while (next_pair(&one, &options))
        if (one.key_length == length && one.length > length && strncmp(one.text, key, length) == 0)
            snprintf(value, FM_OPTION_VALUE_BYTES, "%.*s", (int)(one.length - length - 1),
                     one.text + length + 1);
}

bool options_are_same(const char *a, const char *b, fm_options_sort sort,
                      const fm_text_list *without)
{
    pair of_a, of_b;
    for (;;) {
        const bool has_a = next_wanted(&of_a, &a, sort, without);
        const bool has_b = next_wanted(&of_b, &b, sort, without);
        if (!has_a || !has_b)
            return has_a == has_b;
        if (of_a.length != of_b.length || strncmp(of_a.text, of_b.text, of_a.length) != 0)
            return false;
    }
}

void options_drop(char kept[FM_OPTIONS_TEXT_BYTES], const char *options, const char *defaults)
{
    pair one, usual;
    size_t used = 0;
    kept[0] = '\0';
    while (next_pair(&one, &options)) {
        bool is_default = false;
        for (const char *rest = defaults != NULL ? defaults : ""; next_pair(&usual, &rest);)
            is_default |=
                usual.length == one.length && strncmp(usual.text, one.text, one.length) == 0;
        if (!is_default && used + one.length + 2 < FM_OPTIONS_TEXT_BYTES)
            used += (size_t)snprintf(kept + used, FM_OPTIONS_TEXT_BYTES - used, "%s%.*s",
                                     used > 0 ? " " : "", (int)one.length, one.text);
    }
}

void options_select(char chosen[FM_OPTIONS_TEXT_BYTES], const char *options, fm_options_sort sort,
                    const fm_text_list *without)
{
    pair one;
    size_t used = 0;
    chosen[0] = '\0';
    while (next_wanted(&one, &options, sort, without))
        if (used + one.length + 2 < FM_OPTIONS_TEXT_BYTES)
            used += (size_t)snprintf(chosen + used, FM_OPTIONS_TEXT_BYTES - used, "%s%.*s",
                                     used > 0 ? " " : "", (int)one.length, one.text);
}
