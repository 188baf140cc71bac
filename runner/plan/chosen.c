#include "chosen.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "decide/precision.h"
#include "model/feeds.h"
#include "plan_case.h"
#include "scene/scene_file.h"

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the plan");
}

static bool is_control(const fm_plugin_entry *entry)
{
    return entry->plugin != NULL && (entry->plugin->method->traits & FM_TRAIT_CONTROL) != 0;
}

static void add_method(fm_chosen *chosen, fm_plugin_entry *entry)
{
    for (size_t i = 0; i < chosen->method_count; i++)
        if (chosen->methods[i] == entry)
            return;
    chosen->methods[chosen->method_count++] = entry;
}

static uint32_t chosen_feeds(const fm_chosen *chosen)
{
    const fm_text_list *names = &chosen->selection.names[FM_LISTED_FEEDS];
    uint32_t feeds = 0;
    for (size_t i = 0; i < names->count; i++)
        feeds |= feed_from_name(names->items[i]);
    return feeds;
}

/* Whether the method belongs to a world that the feeds are of: fragments, triangles or frames. One
 * that was refused belongs to none. */
static bool takes_some(const fm_plugin_entry *entry, uint32_t feeds)
{
    if (entry->plugin == NULL)
        return false;
    const uint32_t taken = entry->plugin->method->feeds;
    const bool is_alone = taken == FM_FEED_FRAMES || taken == FM_FEED_TRIANGLES;
    return (feeds & (is_alone ? taken : FM_FEEDS_FRAGMENTS)) != 0;
}

/* All that can be used and are no controls, of the kind that the feeds are for. */
static fm_status add_all_methods(fm_chosen *chosen, const fm_plugin_list *plugins, fm_error *err)
{
    const uint32_t feeds = chosen_feeds(chosen);
    const fm_status status = plugin_list_read_all(plugins, err);
    for (size_t i = 0; i < plugins->count && status == FM_OK; i++)
        if (!is_control(&plugins->entries[i]) && takes_some(&plugins->entries[i], feeds))
            add_method(chosen, &plugins->entries[i]);
    return status;
}

static fm_status add_named(fm_chosen *chosen, const fm_plugin_list *plugins, size_t i,
                           fm_error *err)
{
    fm_plugin_entry *entry = NULL;
    const char *name = chosen->selection.names[FM_LISTED_METHODS].items[i];
    if (strcmp(name, "all") == 0)
        return add_all_methods(chosen, plugins, err);
    if (plugin_list_get(&entry, plugins, name, err) != FM_OK)
        return fm_error_prefix(err, "%s", chosen->selection.origins[FM_LISTED_METHODS].items[i]);
    add_method(chosen, entry);
    return FM_OK;
}

/* The first chosen method that was refused; NULL: none was. */
static const fm_plugin_entry *find_refused(const fm_chosen *chosen)
{
    for (size_t i = 0; i < chosen->method_count; i++)
        if (plugin_entry_is_refused(chosen->methods[i]))
            return chosen->methods[i];
    return NULL;
}

/* One that can be used is enough: the others are rows that say why not. */
static fm_status expect_usable(const fm_chosen *chosen, fm_error *err)
{
    if (chosen->method_count == 0)
        return fm_fail(err, FM_INVALID, "no method was found; `list methods` shows where");
    for (size_t i = 0; i < chosen->method_count; i++)
        if (chosen->methods[i]->plugin != NULL)
            return FM_OK;
    return fm_fail(err, FM_INVALID, "method '%s' is refused: %s", chosen->methods[0]->id,
                   chosen->methods[0]->error.message);
}

static fm_status find_methods(fm_chosen *chosen, const fm_plugin_list *plugins, fm_error *err)
{
    const fm_text_list *names = &chosen->selection.names[FM_LISTED_METHODS];
    chosen->methods = calloc(plugins->count + 1, sizeof *chosen->methods);
    if (chosen->methods == NULL)
        return no_memory(err);
    fm_status status = names->count == 0 ? add_all_methods(chosen, plugins, err) : FM_OK;
    for (size_t i = 0; i < names->count && status == FM_OK; i++)
        status = add_named(chosen, plugins, i, err);
    if (status == FM_OK)
        status = plugin_list_read(plugins, chosen->methods, chosen->method_count, err);
    return status == FM_OK ? expect_usable(chosen, err) : status;
}

/* A list that was left open gets its default. */
static fm_status fill_list(fm_chosen *chosen, fm_listed list, const char *name, fm_error *err)
{
    if (chosen->selection.names[list].count > 0)
        return FM_OK;
    if (!text_list_add(&chosen->selection.names[list], name) ||
        !text_list_add(&chosen->selection.origins[list], "default"))
        return no_memory(err);
    return FM_OK;
}

static fm_status find_scene(fm_chosen_scene *scene, const char *name, const char *origin,
                            fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    if (strlen(name) >= sizeof scene->name)
        return fm_fail(err, FM_INVALID, "%s: scene '%.100s...': longer than %zu bytes", origin,
                       name, sizeof scene->name - 1);
    strcpy(scene->name, name);
    fm_status status = scene_file_find(path, name, err);
    if (status == FM_OK)
        status = scene_file_read(&scene->settings, path, err);
    return status == FM_OK ? FM_OK : fm_error_prefix(err, "%s", origin);
}

static fm_status find_scenes(fm_chosen *chosen, fm_error *err)
{
    const fm_text_list *names = &chosen->selection.names[FM_LISTED_SCENES];
    chosen->scenes = calloc(names->count, sizeof *chosen->scenes);
    if (chosen->scenes == NULL)
        return no_memory(err);
    for (size_t i = 0; i < names->count; i++) {
        const fm_status status =
            find_scene(&chosen->scenes[i], names->items[i],
                       chosen->selection.origins[FM_LISTED_SCENES].items[i], err);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static fm_status unknown(const char *origin, const char *what, const char *name,
                         const char *nearest, fm_error *err)
{
    return fm_fail(err, FM_INVALID, "%s: no %s '%.200s'%s%s%s", origin, what, name,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "");
}

static fm_status find_devices(fm_chosen *chosen, const fm_device_list *known, fm_error *err)
{
    const fm_text_list *names = &chosen->selection.names[FM_LISTED_DEVICES];
    chosen->devices = calloc(names->count, sizeof *chosen->devices);
    if (chosen->devices == NULL)
        return no_memory(err);
    for (size_t i = 0; i < names->count; i++) {
        const char *name = names->items[i];
        chosen->devices[i] = device_find(known, name);
        if (chosen->devices[i] == NULL)
            return unknown(chosen->selection.origins[FM_LISTED_DEVICES].items[i], "device", name,
                           device_nearest(known, name), err);
    }
    return FM_OK;
}

static fm_status check_feed(const char *name, const char *origin, fm_error *err)
{
    const char *known[FM_FEED_COUNT + 1];
    if (feed_from_name(name) != 0)
        return FM_OK;
    const size_t count = feed_names(known, FM_FEEDS_ALL);
    return unknown(origin, "feed", name, text_nearest(name, known, count), err);
}

static fm_status check_feeds(fm_chosen *chosen, fm_error *err)
{
    const fm_text_list *names = &chosen->selection.names[FM_LISTED_FEEDS];
    const fm_text_list *origins = &chosen->selection.origins[FM_LISTED_FEEDS];
    fm_status status = FM_OK;
    for (size_t i = 0; status == FM_OK && i < names->count; i++)
        status = check_feed(names->items[i], origins->items[i], err);
    return status;
}

static const fm_method_desc *method_of(const fm_chosen *chosen, size_t i)
{
    return chosen->methods[i]->plugin != NULL ? chosen->methods[i]->plugin->method : NULL;
}

static fm_status unknown_option(const fm_chosen *chosen, const fm_sweep *sweep, fm_error *err)
{
    const char *known[FM_MAX_OPTIONS + 2] = { selection_nearest(sweep->name) };
    const char *nearest = known[0];
    for (size_t i = 0; i < chosen->method_count; i++) {
        const fm_method_desc *method = method_of(chosen, i);
        size_t count = 0;
        if (nearest != NULL)
            known[count++] = nearest;
        for (size_t j = 0; method != NULL && j < FM_MAX_OPTIONS; j++)
            if (method->options[j].name != NULL)
                known[count++] = method->options[j].name;
        nearest = text_nearest(sweep->name, known, count);
    }
    const fm_plugin_entry *refused = find_refused(chosen);
    if (refused != NULL) /* which may have had it */
        return fm_fail(err, FM_INVALID, "%s: no key '%.200s', and method '%s' is refused: %s",
                       sweep->origin, sweep->name, refused->id, refused->error.message);
    return unknown(sweep->origin, "key or option of a chosen method", sweep->name, nearest, err);
}

/* "8|16|32" behind what the text has. */
static void add_values(char text[FM_TEXT_MAX], const fm_option *option)
{
    for (size_t i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++) {
        const size_t used = strlen(text);
        snprintf(text + used, FM_TEXT_MAX - used, "%s%s", used > 0 ? "|" : "", option->values[i]);
    }
}

/* A value that no chosen method's option has is a mistake, not a case to skip. */
static fm_status check_option_value(const fm_chosen *chosen, const fm_sweep *sweep,
                                    const char *value, fm_error *err)
{
    char legal[FM_TEXT_MAX] = "";
    for (size_t i = 0; i < chosen->method_count; i++) {
        const fm_method_desc *method = method_of(chosen, i);
        const fm_option *option = method != NULL ? option_find(method, sweep->name) : NULL;
        if (option == NULL)
            continue;
        if (option_has_value(option, value) || auto_is_published(option->name, value))
            return FM_OK;
        if (legal[0] == '\0')
            add_values(legal, option);
    }
    return fm_fail(err, FM_INVALID, "%s: '%.100s' is not a legal value; legal: %s", sweep->origin,
                   value, legal);
}

static fm_status check_option(const fm_chosen *chosen, const fm_sweep *sweep, fm_error *err)
{
    bool is_known = false;
    fm_status status = FM_OK;
    for (size_t i = 0; i < chosen->method_count; i++)
        is_known |=
            method_of(chosen, i) != NULL && option_find(method_of(chosen, i), sweep->name) != NULL;
    if (!is_known)
        return unknown_option(chosen, sweep, err);
    for (size_t i = 0; status == FM_OK && i < sweep->values.count; i++)
        status = check_option_value(chosen, sweep, sweep->values.items[i], err);
    return status;
}

/* Whether a scene reads the key, with the generator that an axis may have given it. */
static bool is_read_somewhere(const fm_chosen *chosen, const fm_key *key)
{
    const size_t scene_count = chosen->selection.names[FM_LISTED_SCENES].count;
    if (selection_find(&chosen->selection, "generator") != NULL)
        return true;
    for (size_t i = 0; i < scene_count; i++)
        if (key_is_read(key, chosen->scenes[i].settings.generator))
            return true;
    return false;
}

static fm_status check_sweep(const fm_chosen *chosen, const fm_sweep *sweep, fm_error *err)
{
    if (sweep->key == NULL)
        return check_option(chosen, sweep, err);
    if (sweep->key->scope == FM_SCOPE_RUN && sweep->values.count > 1)
        return fm_fail(err, FM_INVALID, "%s: %s has one value a run", sweep->origin, sweep->name);
    if (!is_read_somewhere(chosen, sweep->key))
        return fm_fail(err, FM_INVALID, "%s: no chosen scene reads '%s'", sweep->origin,
                       sweep->name);
    return FM_OK;
}

/* Which ends before the first look could be. */
static fm_status check_precision(const fm_chosen *chosen, fm_error *err)
{
    const fm_sweep *precision = selection_find(&chosen->selection, "precision");
    const fm_sweep *launches = selection_find(&chosen->selection, "launches");
    fm_settings settings;
    settings_default(&settings);
    if (precision == NULL || launches == NULL)
        return FM_OK;
    settings_set(&settings, precision->key, precision->values.items[0], NULL);
    settings_set(&settings, launches->key, launches->values.items[0], NULL);
    if (settings.precision_percent <= 0.0 || settings.launches >= PRECISION_FIRST)
        return FM_OK;
    return fm_fail(err, FM_INVALID,
                   "%s: launches = %u: with precision it is the most that there may be, and the "
                   "first look is at %d",
                   launches->origin, settings.launches, PRECISION_FIRST);
}

/* The feed of runs that name none. */
static const char *usual_feed(const fm_chosen *chosen)
{
    return device_feeds(chosen->devices[0]) == FM_FEED_FRAMES ? "frames" : "raster";
}

static fm_status look_up(fm_chosen *chosen, const fm_device_list *known_devices,
                         const fm_plugin_list *plugins, fm_error *err)
{
    fm_status status = fill_list(chosen, FM_LISTED_SCENES, "layers", err);
    if (status == FM_OK)
        status = fill_list(chosen, FM_LISTED_DEVICES, "vulkan", err);
    if (status == FM_OK)
        status = find_devices(chosen, known_devices, err);
    if (status == FM_OK)
        status = fill_list(chosen, FM_LISTED_FEEDS, usual_feed(chosen), err);
    if (status == FM_OK)
        status = check_feeds(chosen, err);
    if (status == FM_OK)
        status = find_methods(chosen, plugins, err);
    if (status == FM_OK)
        status = find_scenes(chosen, err);
    for (size_t i = 0; status == FM_OK && i < chosen->selection.sweep_count; i++)
        status = check_sweep(chosen, &chosen->selection.sweeps[i], err);
    if (status == FM_OK)
        status = check_precision(chosen, err);
    return status;
}

fm_status chosen_create(fm_chosen *chosen, const fm_plan_request *request,
                        const fm_plugin_list *plugins, fm_error *err)
{
    *chosen = (fm_chosen){ 0 };
    fm_status status = selection_read(&chosen->selection, request, err);
    if (status == FM_OK)
        status = look_up(chosen, request->known_devices, plugins, err);
    if (status != FM_OK)
        chosen_destroy(chosen);
    return status;
}

void chosen_destroy(fm_chosen *chosen)
{
    free(chosen->devices);
    free(chosen->scenes);
    free(chosen->methods);
    selection_free(&chosen->selection);
    *chosen = (fm_chosen){ 0 };
}
