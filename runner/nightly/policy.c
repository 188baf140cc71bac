#include "policy.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <xxhash.h>

#include "base/yaml_fields.h"

enum { BUDGET_MINUTES = 10, LEAST = 3, MOST = 40, LAUNCHES = 1000 };
static const double budget_most_minutes = 24 * 60, usual_effect_percent = 6;

static const char *const policy_keys[] = {
    "methods",        "scenes",        "devices",   "feeds",          "axes",
    "plugin_dirs",    "build",         "base",      "spec",           "output",
    "state",          "baseline",      "reference", "budget_minutes", "effect_percent",
    "launches_least", "launches_most",
};

/* Of the budget. */
static const double share_with_base = 0.6, share_without = 0.9;

/* A path as it is seen from the policy's folder; "": the key is not there. */
static fm_status take_path(char to[FM_PATH_MAX_BYTES], const fm_yaml *map, const char *key,
                           const fm_yaml_place *at)
{
    const char *text = "";
    const fm_status status = field_text(&text, map, key, false, at);
    if (status != FM_OK || text[0] == '\0')
        return status;
    return path_beside(to, FM_PATH_MAX_BYTES, at->path, text)
               ? FM_OK
               : fm_fail(at->err, FM_INVALID, "%s: %s: too long a path", at->path, key);
}

static fm_status take_word(char *to, size_t room, const fm_yaml *map, const char *key,
                           const fm_yaml_place *at)
{
    const char *text = "";
    const fm_status status = field_text(&text, map, key, false, at);
    if (status != FM_OK)
        return status;
    return snprintf(to, room, "%s", text) < (int)room
               ? FM_OK
               : fm_fail(at->err, FM_INVALID, "%s: %s: longer than %zu bytes", at->path, key,
                         room - 1);
}

static fm_status take_number(double *value, double least, double most, const fm_yaml *map,
                             const char *key, const fm_yaml_place *at)
{
    const fm_status status = field_number(value, map, key, at);
    if (status != FM_OK)
        return status;
    const fm_yaml *field = yaml_tree_find(map, key);
    return *value >= least && *value <= most
               ? FM_OK
               : fm_fail(at->err, FM_INVALID, "%s:%u: %s: from %g to %g", at->path,
                         field != NULL ? field->line : 0, key, least, most);
}

static fm_status take_launches(uint32_t *launches, const fm_yaml *map, const char *key,
                               const fm_yaml_place *at)
{
    double value = *launches;
    const fm_status status = take_number(&value, 1, LAUNCHES, map, key, at);
    if (status == FM_OK && value != floor(value))
        return fm_fail(at->err, FM_INVALID, "%s: %s: a whole number", at->path, key);
    *launches = (uint32_t)value;
    return status;
}

static fm_status take_lists(fm_policy *policy, const fm_yaml *map, const fm_yaml_place *at)
{
    const struct {
        fm_text_list *list;
        const char *key;
    } lists[] = {
        { &policy->methods, "methods" }, { &policy->scenes, "scenes" },
        { &policy->devices, "devices" }, { &policy->feeds, "feeds" },
        { &policy->axes, "axes" },
    };
    fm_status status = FM_OK;
    for (size_t i = 0; i < sizeof lists / sizeof lists[0] && status == FM_OK; i++)
        status = field_list(lists[i].list, map, lists[i].key, at);
    return status;
}

/* Folders of plugins, as they are seen from the policy's. */
static fm_status take_plugins(fm_policy *policy, const fm_yaml *map, const fm_yaml_place *at)
{
    fm_text_list names = { 0 };
    fm_status status = field_list(&names, map, "plugin_dirs", at);
    for (size_t i = 0; i < names.count && status == FM_OK; i++) {
        char path[FM_PATH_MAX_BYTES];
        if (!path_beside(path, sizeof path, at->path, names.items[i]))
            status = fm_fail(at->err, FM_INVALID, "%s: plugin_dirs: too long a path", at->path);
        else if (!text_list_add(&policy->plugin_folders, path))
            status = fm_fail(at->err, FM_NO_MEMORY, "%s: no memory", at->path);
    }
    text_list_free(&names);
    return status;
}

static fm_status take_build(fm_policy *policy, const fm_yaml *map, const fm_yaml_place *at)
{
    const char *slash = strrchr(at->path, '/');
    const int length = slash != NULL ? (int)(slash - at->path) : 1;
    const fm_status status = field_list(&policy->build, map, "build", at);
    if (status != FM_OK)
        return status;
    if (yaml_tree_find(map, "build") != NULL &&
        (policy->build.count == 0 || policy->build.items[0][0] == '\0'))
        return fm_fail(at->err, FM_INVALID, "%s:%u: build: a command and its arguments", at->path,
                       yaml_tree_find(map, "build")->line);
    if (length >= FM_PATH_MAX_BYTES)
        return fm_fail(at->err, FM_INVALID, "%.64s...: too long a path", at->path);
    snprintf(policy->folder, sizeof policy->folder, "%.*s", length > 0 ? length : 1,
             slash == NULL ? "." : at->path);
    return FM_OK;
}

static fm_status take_numbers(fm_policy *policy, const fm_yaml *map, const fm_yaml_place *at)
{
    double percent = usual_effect_percent;
    fm_status status =
        take_number(&policy->budget_minutes, 0.1, budget_most_minutes, map, "budget_minutes", at);
    if (status == FM_OK)
        status = take_number(&percent, 0.1, 1000, map, "effect_percent", at);
    policy->effect = 1.0 + percent / 100.0;
    if (status == FM_OK)
        status = take_launches(&policy->launches_least, map, "launches_least", at);
    if (status == FM_OK)
        status = take_launches(&policy->launches_most, map, "launches_most", at);
    if (status == FM_OK && policy->launches_least > policy->launches_most)
        status = fm_fail(at->err, FM_INVALID, "%s: launches_least %u is above launches_most %u",
                         at->path, policy->launches_least, policy->launches_most);
    return status;
}

static fm_status take_fields(fm_policy *policy, const fm_yaml *map, const fm_yaml_place *at)
{
    fm_status status = field_check_keys(map, "policy", policy_keys,
                                        sizeof policy_keys / sizeof policy_keys[0], at);
    if (status == FM_OK)
        status = take_lists(policy, map, at);
    if (status == FM_OK)
        status = take_plugins(policy, map, at);
    if (status == FM_OK)
        status = take_build(policy, map, at);
    if (status == FM_OK)
        status = take_path(policy->base, map, "base", at);
    if (status == FM_OK)
        status = take_path(policy->spec, map, "spec", at);
    if (status == FM_OK)
        status = take_path(policy->output, map, "output", at);
    if (status == FM_OK)
        status = take_path(policy->state, map, "state", at);
    if (status == FM_OK)
        status = take_word(policy->baseline, sizeof policy->baseline, map, "baseline", at);
    if (status == FM_OK)
        status = take_word(policy->reference, sizeof policy->reference, map, "reference", at);
    return status == FM_OK ? take_numbers(policy, map, at) : status;
}

static void add_list(fm_text *text, const fm_text_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        text_add(text, "%s\n", list->items[i]);
    text_add(text, "\n");
}

/* Of what is measured alone: budget, baseline and folders may change between nights. */
static fm_status find_hash(fm_policy *policy, fm_error *err)
{
    fm_text text = { 0 };
    add_list(&text, &policy->methods);
    add_list(&text, &policy->scenes);
    add_list(&text, &policy->devices);
    add_list(&text, &policy->feeds);
    add_list(&text, &policy->axes);
    text_add(&text, "%s\n", policy->spec);
    if (!text.failed)
        snprintf(policy->hash, sizeof policy->hash, "%016llx",
                 (unsigned long long)XXH3_64bits(text.bytes, text.length));
    const bool has_memory = !text.failed;
    text_free(&text);
    return has_memory ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for a policy");
}

static fm_status use_defaults(fm_policy *policy, fm_error *err)
{
    static const char *const axes[] = { "width_px=214", "height_px=120", "n=32" };
    for (size_t i = 0; i < sizeof axes / sizeof axes[0]; i++)
        if (!text_list_add(&policy->axes, axes[i]))
            return fm_fail(err, FM_NO_MEMORY, "no memory for a policy");
    return FM_OK;
}

fm_status policy_read(fm_policy *policy, const char *path, fm_error *err)
{
    fm_yaml *root = NULL;
    *policy = (fm_policy){ .budget_minutes = BUDGET_MINUTES,
                           .effect = 1.0 + usual_effect_percent / 100.0,
                           .launches_least = LEAST,
                           .launches_most = MOST };
    fm_status status = FM_OK;
    if (path == NULL)
        status = use_defaults(policy, err);
    else
        status = yaml_tree_read(&root, path, err);
    if (status == FM_OK && path != NULL)
        status = take_fields(policy, root, &(fm_yaml_place){ path, err });
    yaml_tree_free(root);
    return status == FM_OK ? find_hash(policy, err) : status;
}

double policy_seconds(const fm_policy *policy, double built_s)
{
    return fmax(60.0 * policy->budget_minutes - built_s, 0.0);
}

double policy_launch_share(const fm_policy *policy)
{
    return policy->base[0] != '\0' ? share_with_base : share_without;
}

void policy_free(fm_policy *policy)
{
    text_list_free(&policy->build);
    text_list_free(&policy->plugin_folders);
    text_list_free(&policy->axes);
    text_list_free(&policy->feeds);
    text_list_free(&policy->devices);
    text_list_free(&policy->scenes);
    text_list_free(&policy->methods);
    *policy = (fm_policy){ 0 };
}
