#include "plan_case.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "decide/precision.h"
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

/* Whether fragments go through the compositor: not of a floor, nor of a technique's sequences. */
static bool hands_over(const fm_method_desc *method)
{
    for (size_t i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].emits)
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
    if (!hands_over(method)) {
        settings->accumulate = FM_ACCUMULATE_FLOAT32;
        settings->composite = FM_COMPOSITE_FRONT_TO_BACK;
    }
    if (method->technique == NULL) {
        settings->model = "";
    } else {
        settings->timers = FM_TIMERS_PASSES;
        settings->exposure = 0; /* their frames hold bytes */
    }
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

bool case_is_given(const fm_case *planned, const fm_key *key)
{
    const size_t index = (size_t)(key - fm_keys);
    return (planned->given[index / 64] >> index % 64 & 1u) != 0;
}

static void mark_given(fm_case *made, const fm_plan_point *point)
{
    for (size_t i = 0; i < point->selection->sweep_count; i++) {
        const fm_key *key = point->selection->sweeps[i].key;
        if (key != NULL)
            made->given[(key - fm_keys) / 64] |= UINT64_C(1) << (key - fm_keys) % 64;
    }
}

/* The value that an axis gives the option; its first one, if none does. */
static const char *choice_value(const fm_plan_point *point, const fm_option *option)
{
    const char *value = option->values[0];
    for (size_t i = 0; i < point->selection->sweep_count; i++) {
        const fm_sweep *sweep = &point->selection->sweeps[i];
        if (sweep->key == NULL && strcmp(sweep->name, option->name) == 0)
            value = sweep_value(point, i);
    }
    return value;
}

/* All options, in the order of the descriptor: two ways to say the same are the same, and what is
 * measured hangs on no default that may be another one tomorrow. */
static fm_status make_choices(fm_case *made, const fm_plan_point *point,
                              const fm_method_desc *method, fm_error *err)
{
    size_t count = 0;
    while (count < FM_MAX_OPTIONS && method->options[count].name != NULL)
        count++;
    if (count == 0)
        return FM_OK;
    made->choices = calloc(count, sizeof *made->choices);
    if (made->choices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for a case's options");
    made->choice_count = count;
    for (size_t i = 0; i < count; i++) {
        fm_choice *choice = &made->choices[i];
        snprintf(choice->name, sizeof choice->name, "%s", method->options[i].name);
        snprintf(choice->value, sizeof choice->value, "%s",
                 choice_value(point, &method->options[i]));
    }
    return FM_OK;
}

/* false: nobody knows the device. */
static bool know_device(const fm_plan_point *point)
{
    fm_device_memo *memo = point->device_memo;
    if (memo == NULL || memo->request->ask == NULL)
        return false;
    if (!memo->was_asked)
        memo->request->ask(&memo->device, memo->request->context, point->device, &memo->error);
    memo->was_asked = true;
    return memo->error.status == FM_OK;
}

static void work_out_options(fm_case *made, const fm_plan_point *point)
{
    const fm_auto_case of = auto_case(point->entry->plugin->method, &made->settings, 0);
    bool is_open = false;
    for (size_t i = 0; i < made->choice_count; i++) {
        const bool is_auto = strcmp(made->choices[i].value, AUTO_VALUE) == 0;
        const bool is_open_too = auto_is_open(&made->choices[i]);
        is_open |= is_open_too;
        made->worked_out |= (uint32_t)(is_open_too && is_auto) << i;
    }
    if (is_open && know_device(point))
        auto_resolve(made->choices, made->choice_count, &of, &point->device_memo->device);
}

static void list_names(fm_text *why, const char *const *names, size_t count)
{
    for (size_t i = 0; i < count && names[i] != NULL; i++)
        text_add(why, "%s%s", i > 0 ? ", " : " ", names[i]);
}

/* Why a case cannot run, one check a function, which adds to *why and returns the reason;
 * FM_REASON_NONE: it can. */

static fm_reason refuse_feed(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    const fm_method_desc *method = point->entry->plugin->method;
    const char *taken[FM_FEED_COUNT + 1];
    const size_t count = feed_names(taken, method_feeds(method));
    if ((method_feeds(method) & feed_from_name(made->feed)) != 0)
        return FM_REASON_NONE;
    text_add(why, "feed '%s': the method takes", made->feed);
    list_names(why, taken, count);
    return FM_REASON_FEED;
}

/* Frames are for their own device and from their own generator, fragments for and from all others.
 */
static fm_reason refuse_place(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    const uint32_t feed = feed_from_name(made->feed);
    const bool has_frames = generator_makes_frames(made->settings.generator);
    if ((device_feeds(point->ops) & feed) == 0)
        text_add(why, "feed '%s': device %s does not take it", made->feed, point->ops->name);
    else if (has_frames != (feed == FM_FEED_FRAMES))
        text_add(why, "feed '%s': the scene is made of %s", made->feed,
                 has_frames ? "frames" : "fragments");
    else
        return FM_REASON_NONE;
    return FM_REASON_FEED;
}

static fm_reason refuse_k(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    const fm_method_desc *method = point->entry->plugin->method;
    const uint32_t k = made->settings.k;
    if (!plugin_has_k(method))
        return FM_REASON_NONE;
    if (k == 0)
        text_add(why, "k = none: the method keeps the k nearest");
    else if (method->k_max != 0 && k > method->k_max)
        text_add(why, "k = %u: the method's largest is %u", k, method->k_max);
    else
        return FM_REASON_NONE;
    return FM_REASON_SETTING;
}

static fm_reason refuse_choice(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    const fm_method_desc *method = point->entry->plugin->method;
    for (size_t i = 0; i < made->choice_count; i++) {
        const fm_choice *choice = &made->choices[i];
        const fm_option *option = option_find(method, choice->name);
        if (option_has_value(option, choice->value))
            continue;
        text_add(why, "%s = %s: the method has", choice->name, choice->value);
        list_names(why, option->values, FM_MAX_OPTION_VALUES);
        return FM_REASON_SETTING;
    }
    return FM_REASON_NONE;
}

static fm_reason refuse_passes(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    fm_method_desc chosen;
    fm_error err;
    method_choose(&chosen, point->entry->plugin->method, made->choices, made->choice_count);
    if (culling_check(&chosen, &made->settings, feed_from_name(made->feed), &err) == FM_OK)
        return FM_REASON_NONE;
    text_add(why, "%s", err.message);
    return err.reason;
}

/* Other than front to back needs a method that can hand over so, which its traits say. */
static fm_reason refuse_composite(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    const uint32_t traits = point->entry->plugin->method->traits;
    if (made->settings.composite == FM_COMPOSITE_FRONT_TO_BACK ||
        (traits & FM_TRAIT_EMITS_EITHER) != 0)
        return FM_REASON_NONE;
    text_add(why, "composite = back-to-front: %s hands over %s", made->method,
             (traits & FM_TRAIT_EMITS_BACK) != 0 ? "from both ends" : "front to back");
    return FM_REASON_SETTING;
}

static fm_reason refuse_method(fm_text *why, const fm_case *made, const fm_plan_point *point)
{
    static fm_reason (*const checks[])(fm_text *, const fm_case *, const fm_plan_point *) = {
        refuse_feed, refuse_place, refuse_k, refuse_choice, refuse_passes, refuse_composite,
    };
    fm_reason reason = FM_REASON_NONE;
    for (size_t i = 0; i < sizeof checks / sizeof checks[0] && reason == FM_REASON_NONE; i++)
        reason = checks[i](why, made, point);
    return reason;
}

static void remember_mesh(fm_mesh_memo *memo, const char *path)
{
    if (memo->path == path)
        return;
    *memo = (fm_mesh_memo){ .path = path };
    if (settings_mesh_digest(&memo->digest, path, &memo->error) != FM_OK)
        memo->digest = XXH64(path, strlen(path), 0);
}

static fm_status make_skip(fm_case *made, const fm_plan_point *point, fm_error *err)
{
    const fm_plugin_entry *entry = point->entry;
    const bool has_file = settings_file(&made->settings) != NULL;
    fm_text why = { 0 };
    if (entry->plugin == NULL)
        text_add(&why, "%s", entry->error.message);
    else
        made->skip_reason = refuse_method(&why, made, point);
    made->is_unread = why.length == 0 && has_file && point->memo->error.status != FM_OK;
    if (made->is_unread)
        made->skip_reason = FM_REASON_SCENE;
    if (made->is_unread)
        text_add(&why, "%s: %s", settings_file_key(&made->settings), point->memo->error.message);
    assert(why.length == 0 || entry->plugin == NULL || made->skip_reason != FM_REASON_NONE);
    made->skip = why.bytes;
    made->skip_status = entry->plugin == NULL ? FM_CASE_PLUGIN_ERROR : FM_CASE_NOT_SUPPORTED;
    return why.failed ? fm_fail(err, FM_NO_MEMORY, "no memory for a case's reason") : FM_OK;
}

static uint64_t mix(uint64_t mixed, const char *text)
{
    return XXH64(text, strlen(text) + 1, mixed);
}

static uint64_t mix_choices(uint64_t mixed, const fm_case *made)
{
    for (size_t i = 0; i < made->choice_count; i++)
        mixed = mix(mix(mixed, made->choices[i].name), made->choices[i].value);
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
    mixed = mix_choices(mixed, made);
    snprintf(made->id, sizeof made->id, "%016llx", (unsigned long long)mixed);
}

/* Simulated launches all say the same: one, unless somebody wants more, and none for precision. */
static void fill_launches(fm_case *made, const fm_plan_point *point)
{
    const bool is_simulated = strcmp(point->feed, feed_name(FM_FEED_FRAMES)) == 0;
    const bool is_adaptive = made->settings.precision_percent > 0.0;
    const bool is_given = case_is_given(made, key_find("launches"));
    if (is_simulated && (is_adaptive || !is_given))
        made->settings.launches = 1;
    else if (is_adaptive && !is_given)
        made->settings.launches = PRECISION_LAST;
    if (is_simulated)
        made->settings.precision_percent = 0.0;
}

static fm_status make_case(fm_case *made, const fm_plan_point *point, fm_error *err)
{
    fm_status status = make_settings(&made->settings, point, err);
    if (status != FM_OK)
        return status;
    mark_given(made, point);
    fill_launches(made, point);
    snprintf(made->method, sizeof made->method, "%s", point->entry->id);
    snprintf(made->scene, sizeof made->scene, "%s", point->scene);
    snprintf(made->device, sizeof made->device, "%s", point->device);
    snprintf(made->feed, sizeof made->feed, "%s", point->feed);
    if (point->entry->plugin != NULL)
        status = make_choices(made, point, point->entry->plugin->method, err);
    if (status == FM_OK && made->choice_count > 0)
        work_out_options(made, point);
    if (settings_file(&made->settings) != NULL)
        remember_mesh(point->memo, settings_file(&made->settings));
    if (status == FM_OK)
        status = make_skip(made, point, err);
    if (status == FM_OK)
        make_id(made, point);
    return status;
}

fm_status plan_case_make(fm_case *made, const fm_plan_point *point, fm_error *err)
{
    *made = (fm_case){ 0 };
    const fm_status status = make_case(made, point, err);
    if (status != FM_OK)
        plan_case_release(made);
    return status;
}

void plan_case_release(fm_case *made)
{
    free(made->choices);
    free(made->skip);
    *made = (fm_case){ 0 };
}
