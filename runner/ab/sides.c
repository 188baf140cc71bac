#include "sides.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fragmark/method.h"
#include "plan/plan_case.h"

const char *const ab_side_names[AB_SIDE_COUNT] = { "base", "new" };

fm_status side_parse(char method[64], const char **directory, const char *text, fm_error *err)
{
    const char *at = strchr(text, '@');
    const size_t length = at != NULL ? (size_t)(at - text) : 0;
    if (length == 0 || length >= 64 || at[1] == '\0')
        return fm_fail(err, FM_INVALID,
                       "'%.200s': METHOD@DIR, please: the id of a method, and the folder of its "
                       "plugin or of a build",
                       text);
    memcpy(method, text, length);
    method[length] = '\0';
    *directory = at + 1;
    return FM_OK;
}

static bool is_from(const fm_plugin_entry *entry, const char *folder)
{
    const size_t length = strlen(folder);
    return strncmp(entry->path, folder, length) == 0 && entry->path[length] == '/';
}

static bool is_control(const fm_plugin_entry *entry)
{
    return entry->plugin != NULL && (entry->plugin->method->traits & FM_TRAIT_CONTROL) != 0;
}

fm_status side_expect(const fm_plugin_list *plugins, const char *folder, const char *method,
                      fm_error *err)
{
    size_t count = 0;
    const fm_plugin_entry *entry = plugin_list_find(plugins, method);
    if (entry != NULL && is_from(entry, folder))
        return FM_OK;
    const char **ids = calloc(plugins->count + 1, sizeof *ids);
    for (size_t i = 0; i < plugins->count && ids != NULL; i++)
        if (is_from(&plugins->entries[i], folder))
            ids[count++] = plugins->entries[i].id;
    const char *nearest = ids != NULL ? text_nearest(method, ids, count) : NULL;
    free(ids);
    return fm_fail(err, FM_INVALID, "%s has no method '%s'%s%s%s", folder, method,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "");
}

fm_status side_methods(fm_text_list *ids, const fm_plugin_list *plugins, const char *folder,
                       fm_error *err)
{
    fm_status status = plugin_list_read_all(plugins, err);
    for (size_t i = 0; i < plugins->count && status == FM_OK; i++) {
        const fm_plugin_entry *entry = &plugins->entries[i];
        if (is_from(entry, folder) && !is_control(entry) && !text_list_add(ids, entry->id))
            status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu methods", plugins->count);
    }
    return status;
}

/* What a case was asked for, in one line. */
static void add_key(fm_text *key, const fm_case *planned, bool has_method)
{
    char value[FM_PATH_MAX_BYTES];
    text_add(key, "%s\n%s\n%s\n%s\n", has_method ? planned->method : "", planned->scene,
             planned->device, planned->feed);
    for (size_t i = 0; i < fm_key_count; i++) {
        if (!key_is_read(&fm_keys[i], planned->settings.generator))
            continue;
        settings_text(value, &planned->settings, &fm_keys[i]);
        text_add(key, "%s=%s\n", fm_keys[i].name, value);
    }
    for (size_t i = 0; i < planned->choice_count; i++)
        text_add(key, "%s=%s\n", planned->choices[i].name, planned->choices[i].value);
}

static bool has_one_method(const fm_plan *plan)
{
    for (size_t i = 1; i < plan->count; i++)
        if (strcmp(plan->cases[i].method, plan->cases[0].method) != 0)
            return false;
    return true;
}

static fm_status index_keys(fm_text_index *index, const fm_plan *plan, bool has_method,
                            fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < plan->count && status == FM_OK; i++) {
        fm_text key = { 0 };
        add_key(&key, &plan->cases[i], has_method);
        if (key.failed || text_index_add(index, key.bytes, i) == FM_TEXT_INDEX_NONE)
            status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
        text_free(&key);
    }
    return status;
}

static bool has_id(const fm_plan *plan, const char *id)
{
    for (size_t i = 0; i < plan->count; i++)
        if (strcmp(plan->cases[i].id, id) == 0)
            return true;
    return false;
}

/* Adds what the cases of these ids were asked for. */
static fm_status index_chosen(fm_text_index *chosen, const fm_plan *plan, bool has_method,
                              const fm_text_list *ids, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < plan->count && status == FM_OK; i++) {
        fm_text key = { 0 };
        if (!text_list_has(ids, plan->cases[i].id))
            continue;
        add_key(&key, &plan->cases[i], has_method);
        if (key.failed || text_index_add(chosen, key.bytes, i) == FM_TEXT_INDEX_NONE)
            status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
        text_free(&key);
    }
    return status;
}

/* A refused method's one row stands for whatever is chosen of it. */
static void keep_chosen(fm_plan *plan, const fm_text_index *chosen, bool has_method)
{
    size_t kept = 0;
    for (size_t i = 0; i < plan->count; i++) {
        fm_text key = { 0 };
        add_key(&key, &plan->cases[i], has_method);
        if (plan->cases[i].skip_status == FM_CASE_PLUGIN_ERROR ||
            (!key.failed && text_index_find(chosen, key.bytes) != FM_TEXT_INDEX_NONE))
            plan->cases[kept++] = plan->cases[i];
        else
            plan_case_release(&plan->cases[i]);
        text_free(&key);
    }
    plan->count = kept;
}

fm_status sides_choose(fm_plan *base, fm_plan *now, const fm_text_list *ids, fm_error *err)
{
    fm_text_index chosen = { 0 };
    const bool has_method = !(has_one_method(base) && has_one_method(now));
    fm_status status = FM_OK;
    for (size_t i = 0; i < ids->count && status == FM_OK; i++)
        if (!has_id(base, ids->items[i]) && !has_id(now, ids->items[i]))
            status =
                fm_fail(err, FM_INVALID,
                        "no case has the id '%.32s'; `fragmark plan` lists those that there are",
                        ids->items[i]);
    if (status == FM_OK)
        status = index_chosen(&chosen, base, has_method, ids, err);
    if (status == FM_OK)
        status = index_chosen(&chosen, now, has_method, ids, err);
    if (status == FM_OK) {
        keep_chosen(base, &chosen, has_method);
        keep_chosen(now, &chosen, has_method);
    }
    text_index_free(&chosen);
    return status;
}

static fm_status skip(fm_case *planned, const char *why, fm_error *err)
{
    if (planned->skip != NULL)
        return FM_OK;
    planned->skip = strdup(why);
    planned->skip_status = FM_CASE_SKIPPED;
    return planned->skip != NULL ? FM_OK : fm_fail(err, FM_NO_MEMORY, "no memory for a reason");
}

/* A case that one side refuses is no use on the other. */
static fm_status skip_alike(fm_case *base, fm_case *now, fm_error *err)
{
    if (base->skip != NULL && now->skip == NULL)
        return skip(now, "BASE cannot run it", err);
    if (now->skip != NULL && base->skip == NULL)
        return skip(base, "NEW cannot run it", err);
    return FM_OK;
}

/* NEW's row of a method that it refuses: nobody knows which keys and options it has, so that one
 * row stands for all of BASE's. FM_TEXT_INDEX_NONE: it is not refused. */
static size_t find_refused(const fm_plan *now, const fm_case *planned)
{
    for (size_t i = 0; i < now->count; i++)
        if (now->cases[i].skip_status == FM_CASE_PLUGIN_ERROR && now->cases[i].skip != NULL &&
            strcmp(now->cases[i].method, planned->method) == 0)
            return i;
    return FM_TEXT_INDEX_NONE;
}

/* The case of NEW that one of BASE is compared with; FM_TEXT_INDEX_NONE: there is none. */
static size_t find_partner(const fm_text_index *index, const fm_plan *now, const fm_case *planned,
                           bool has_method, bool *failed)
{
    fm_text key = { 0 };
    add_key(&key, planned, has_method);
    *failed = key.failed;
    const size_t at = key.failed ? FM_TEXT_INDEX_NONE : text_index_find(index, key.bytes);
    text_free(&key);
    return at != FM_TEXT_INDEX_NONE ? at : find_refused(now, planned);
}

static fm_status take_pair(ab_pairs *pairs, fm_plan *base, size_t i, fm_plan *now, size_t at,
                           fm_error *err)
{
    if (base->cases[i].skip != NULL && now->cases[at].skip != NULL) {
        pairs->refused++;
        return FM_OK;
    }
    pairs->items[pairs->count++] = (ab_pair){ { i, at } };
    return skip_alike(&base->cases[i], &now->cases[at], err);
}

/* is_joined: [now->count], of NEW's cases. */
static fm_status join_each(ab_pairs *pairs, bool *is_joined, fm_plan *base, fm_plan *now,
                           fm_error *err)
{
    fm_text_index index = { 0 };
    const bool has_method = !(has_one_method(base) && has_one_method(now));
    fm_status status = index_keys(&index, now, has_method, err);
    for (size_t i = 0; i < base->count && status == FM_OK; i++) {
        bool failed;
        const size_t at = find_partner(&index, now, &base->cases[i], has_method, &failed);
        if (failed) {
            status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", base->count);
        } else if (at == FM_TEXT_INDEX_NONE) {
            pairs->unpaired++;
            status = skip(&base->cases[i], "NEW has no such case", err);
        } else {
            is_joined[at] = true;
            status = take_pair(pairs, base, i, now, at, err);
        }
    }
    text_index_free(&index);
    return status;
}

fm_status sides_join(ab_pairs *pairs, fm_plan *base, fm_plan *now, fm_error *err)
{
    *pairs = (ab_pairs){ .items = calloc(base->count + 1, sizeof *pairs->items) };
    bool *is_joined = calloc(now->count + 1, sizeof *is_joined);
    fm_status status = pairs->items != NULL && is_joined != NULL
                           ? join_each(pairs, is_joined, base, now, err)
                           : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", base->count);
    for (size_t i = 0; i < now->count && status == FM_OK; i++)
        if (!is_joined[i]) {
            pairs->unpaired++;
            status = skip(&now->cases[i], "BASE has no such case", err);
        }
    free(is_joined);
    if (status == FM_OK && pairs->count == 0)
        status = fm_fail(
            err, FM_INVALID,
            "BASE and NEW have no case in common that can be run; `fragmark plan` says why");
    if (status != FM_OK)
        sides_free(pairs);
    return status;
}

void sides_free(ab_pairs *pairs)
{
    free(pairs->items);
    *pairs = (ab_pairs){ 0 };
}

void side_case_name(fm_text *name, const fm_case *planned)
{
    char value[FM_PATH_MAX_BYTES];
    text_add(name, "%s", planned->method);
    for (size_t i = 0; i < fm_key_count; i++) {
        const bool is_k = strcmp(fm_keys[i].name, "k") == 0;
        if ((!is_k && !case_is_given(planned, &fm_keys[i])) || fm_keys[i].scope == FM_SCOPE_RUN ||
            (is_k && planned->settings.k == 0))
            continue;
        settings_text(value, &planned->settings, &fm_keys[i]);
        text_add(name, " %s=%s", fm_keys[i].name, value);
    }
    for (size_t i = 0; i < planned->choice_count; i++)
        text_add(name, " %s=%s", planned->choices[i].name, planned->choices[i].value);
    text_add(name, " %s %s %s", planned->scene, planned->device, planned->feed);
}
