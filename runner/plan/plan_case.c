#include "plan_case.h"

#include <stdio.h>
#include <string.h>
#include <xxhash.h>

#include "device/device.h"
#include "model/feeds.h"
#include "plugin/culling_apply.h"

static const char *sweep_value(const fm_plan_point *point, size_t i)
{
    return point->selection->sweeps[i].values.items[point->values[i]];
}

static bool has_sweep(const fm_plan_point *point, const char *name)
{
    return selection_find(point->selection, name) != NULL;
}

static bool has_exclusive_pass(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].exclusive)
            return true;
    return false;
}

static bool has_pixel_pass(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].kind == FM_PASS_PIXELS)
            return true;
    return false;
}

/* Keys that change nothing get one value, so that cases that differ only in them are one case. */
static void forget_unused_scene_keys(fm_settings *settings)
{
    for (size_t i = 0; i < fm_key_count; i++)
        if (!key_is_read(&fm_keys[i], settings->generator))
            settings_set(settings, &fm_keys[i], fm_keys[i].fallback, NULL);
}

static void forget_unused_method_keys(fm_settings *settings, const fm_method_desc *method)
{
    if (!plugin_has_k(method))
        settings->k = 0;
    if (!has_exclusive_pass(method)) {
        settings->lock = FM_LOCK_SPIN;
        settings->own_cull = FM_OWN_CULL_ON;
    }
    for (size_t i = 0; i < fm_key_count; i++)
        if (!settings_key_matters(settings, &fm_keys[i]))
            settings_set(settings, &fm_keys[i], fm_keys[i].fallback, NULL);
    if (!has_pixel_pass(method))
        settings->full_screen = FM_FULL_SCREEN_COMPUTE;
    if (method->technique == NULL)
        memset(settings->model, 0, sizeof settings->model);
    else
        settings->timers = FM_TIMERS_PASSES;
}

static fm_status make_settings(fm_settings *settings, const fm_plan_point *point, fm_error *err)
{
    const fm_selection *selection = point->selection;
    fm_status status = FM_OK;
    *settings = *point->base;
    if (has_sweep(point, "n") || has_sweep(point, "r")) {
        settings->n = FM_NOT_GIVEN;
        settings->r = 0;
    }
    for (size_t i = 0; status == FM_OK && i < selection->sweep_count; i++)
        if (selection->sweeps[i].key != NULL)
            status = settings_set(settings, selection->sweeps[i].key, sweep_value(point, i), err);
    if (status != FM_OK)
        return status;
    forget_unused_scene_keys(settings);
    if (settings_finish(settings, err) != FM_OK)
        return fm_error_prefix(err, "scene '%s'", point->scene);
    if (point->entry->plugin != NULL)
        forget_unused_method_keys(settings, point->entry->plugin->method);
    return FM_OK;
}

static void mark_given(fm_case *made, const fm_plan_point *point)
{
    for (size_t i = 0; i < point->selection->sweep_count; i++)
        if (point->selection->sweeps[i].key != NULL)
            made->is_given[point->selection->sweeps[i].key - fm_keys] = true;
}

/* In the order of the descriptor: two ways to say the same are the same. */
static void make_choices(fm_case *made, const fm_plan_point *point, const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++) {
        for (size_t j = 0; j < point->selection->sweep_count; j++) {
            const fm_sweep *sweep = &point->selection->sweeps[j];
            if (sweep->key != NULL || strcmp(sweep->name, method->options[i].name) != 0)
                continue;
            fm_choice *choice = &made->choices[made->choice_count++];
            snprintf(choice->name, sizeof choice->name, "%s", sweep->name);
            snprintf(choice->value, sizeof choice->value, "%s", sweep_value(point, j));
        }
    }
}

static void skip_list(char *skip, size_t room, const char *start, const char *const *names,
                      size_t count)
{
    size_t length = (size_t)snprintf(skip, room, "%s", start);
    for (size_t i = 0; i < count && names[i] != NULL && length < room; i++)
        length +=
            (size_t)snprintf(skip + length, room - length, "%s%s", i > 0 ? ", " : " ", names[i]);
}

static void skip_for_feed(fm_case *made, const fm_method_desc *method)
{
    const char *taken[FM_FEED_COUNT + 1];
    char start[128];
    const size_t count = feed_names(taken, method_feeds(method));
    if ((method_feeds(method) & feed_from_name(made->feed)) != 0)
        return;
    snprintf(start, sizeof start, "feed '%s': the method takes", made->feed);
    skip_list(made->skip, sizeof made->skip, start, taken, count);
}

/* Frames are for their own device and from their own generator, fragments for and from all others.
 */
static void skip_for_place(fm_case *made)
{
    const uint32_t feed = feed_from_name(made->feed);
    const bool has_frames = generator_makes_frames(made->settings.generator);
    const fm_device_ops *ops = device_find(made->device);
    if (ops != NULL && (device_feeds(ops) & feed) == 0)
        snprintf(made->skip, sizeof made->skip, "feed '%s': device %s does not take it", made->feed,
                 ops->name);
    else if (has_frames != (feed == FM_FEED_FRAMES))
        snprintf(made->skip, sizeof made->skip, "feed '%s': the scene is made of %s", made->feed,
                 has_frames ? "frames" : "fragments");
}

static void skip_for_choice(fm_case *made, const fm_method_desc *method)
{
    for (size_t i = 0; i < made->choice_count && made->skip[0] == '\0'; i++) {
        const fm_choice *choice = &made->choices[i];
        const fm_option *option = option_find(method, choice->name);
        char start[192];
        if (option_has_value(option, choice->value))
            continue;
        snprintf(start, sizeof start, "%s = %s: the method has", choice->name, choice->value);
        skip_list(made->skip, sizeof made->skip, start, option->values, FM_MAX_OPTION_VALUES);
    }
}

static void skip_for_k(fm_case *made, const fm_method_desc *method)
{
    const uint32_t k = made->settings.k;
    if (!plugin_has_k(method))
        return;
    if (k == 0)
        snprintf(made->skip, sizeof made->skip, "k = none: the method keeps the k nearest");
    else if (method->k_max != 0 && k > method->k_max)
        snprintf(made->skip, sizeof made->skip, "k = %u: the method's largest is %u", k,
                 method->k_max);
}

static void skip_for_culling(fm_case *made, const fm_method_desc *method)
{
    fm_error err;
    if (culling_check(method, &made->settings, feed_from_name(made->feed), &err) != FM_OK)
        snprintf(made->skip, sizeof made->skip, "%.500s", err.message);
}

static void remember_mesh(fm_mesh_memo *memo, const char *path)
{
    if (strcmp(memo->path, path) == 0)
        return;
    memo->error = (fm_error){ 0 };
    memcpy(memo->path, path, sizeof memo->path);
    if (settings_mesh_digest(&memo->digest, path, &memo->error) != FM_OK)
        memo->digest = XXH64(path, strlen(path), 0);
}

static void make_skip(fm_case *made, const fm_plan_point *point)
{
    const fm_plugin_entry *entry = point->entry;
    if (entry->plugin == NULL) {
        snprintf(made->skip, sizeof made->skip, "plugin_error: %.400s", entry->error.message);
        return;
    }
    skip_for_feed(made, entry->plugin->method);
    if (made->skip[0] == '\0')
        skip_for_place(made);
    if (made->skip[0] == '\0')
        skip_for_k(made, entry->plugin->method);
    if (made->skip[0] == '\0')
        skip_for_choice(made, entry->plugin->method);
    if (made->skip[0] == '\0')
        skip_for_culling(made, entry->plugin->method);
    if (made->skip[0] == '\0' && point->memo->error.status != FM_OK &&
        settings_file(&made->settings) != NULL)
        snprintf(made->skip, sizeof made->skip, "%s: %.400s", settings_file_key(&made->settings),
                 point->memo->error.message);
}

static uint64_t mix(uint64_t mixed, const char *text)
{
    return XXH64(text, strlen(text) + 1, mixed);
}

static uint64_t mix_choices(uint64_t mixed, const fm_case *made, const fm_method_desc *method)
{
    for (size_t i = 0; i < made->choice_count; i++) {
        const fm_choice *choice = &made->choices[i];
        if (strcmp(option_find(method, choice->name)->values[0], choice->value) == 0)
            continue;
        mixed = mix(mixed, choice->name);
        mixed = mix(mixed, choice->value);
    }
    return mixed;
}

static void make_id(fm_case *made, const fm_plan_point *point)
{
    const fm_method_desc *method =
        point->entry->plugin != NULL ? point->entry->plugin->method : NULL;
    char scene_hash[17], value[FM_PATH_MAX_BYTES];
    settings_scene_hash_of(scene_hash, &made->settings, point->memo->digest);
    uint64_t mixed = mix(0, made->method);
    mixed = mix(mixed, method != NULL && method->version != NULL ? method->version : "");
    mixed = mix(mixed, scene_hash);
    mixed = mix(mixed, made->scene);
    mixed = mix(mixed, made->device);
    mixed = mix(mixed, made->feed);
    for (size_t i = 0; i < fm_key_count; i++) {
        if (fm_keys[i].scope != FM_SCOPE_CASE)
            continue;
        settings_text(value, &made->settings, &fm_keys[i]);
        if (fm_keys[i].is_quiet && strcmp(value, fm_keys[i].fallback) == 0)
            continue;
        mixed = mix(mix(mixed, fm_keys[i].name), value);
    }
    if (method != NULL)
        mixed = mix_choices(mixed, made, method);
    snprintf(made->id, sizeof made->id, "%016llx", (unsigned long long)mixed);
}

fm_status plan_case_make(fm_case *made, const fm_plan_point *point, fm_error *err)
{
    *made = (fm_case){ 0 };
    const fm_status status = make_settings(&made->settings, point, err);
    if (status != FM_OK)
        return status;
    mark_given(made, point);
    if (strcmp(point->feed, feed_name(FM_FEED_FRAMES)) == 0 &&
        !made->is_given[key_find("launches") - fm_keys])
        made->settings.launches = 1;
    snprintf(made->method, sizeof made->method, "%s", point->entry->id);
    snprintf(made->scene, sizeof made->scene, "%s", point->scene);
    snprintf(made->device, sizeof made->device, "%s", point->device);
    snprintf(made->feed, sizeof made->feed, "%s", point->feed);
    if (point->entry->plugin != NULL)
        make_choices(made, point, point->entry->plugin->method);
    if (settings_file(&made->settings) != NULL)
        remember_mesh(point->memo, settings_file(&made->settings));
    make_skip(made, point);
    make_id(made, point);
    return FM_OK;
}
