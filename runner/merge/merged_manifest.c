#include "merged_manifest.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#include "bundle/items_json.h"
#include "bundle/staging.h"

static const char *text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text != NULL ? text : "";
}

/* The least, or the greatest, of a text that sorts: times of UTC. "": a shard has none. */
static const char *extreme(const shard_set *set, const char *name, bool is_latest)
{
    const char *best = text_of(set->folders[0].manifest, name);
    for (size_t i = 1; i < set->count; i++) {
        const char *text = text_of(set->folders[i].manifest, name);
        if (text[0] == '\0' || best[0] == '\0')
            return "";
        best = (strcmp(text, best) > 0) == is_latest ? text : best;
    }
    return best;
}

/* A fact of all machines: "A; B" where they differ. */
static json_t *machine_fact(const shard_set *set, const char *name)
{
    fm_text text = { 0 };
    fm_text_list seen = { 0 };
    json_t *value = NULL;
    for (size_t i = 0; i < set->count; i++) {
        const json_t *machine = json_object_get(set->folders[i].manifest, "machine");
        json_t *of = json_object_get(machine, name);
        char *dumped = of != NULL ? json_dumps(of, JSON_ENCODE_ANY) : NULL;
        const char *told = json_is_string(of) ? json_string_value(of) : dumped;
        if (told != NULL && !text_list_has(&seen, told)) {
            text_add(&text, "%s%s", seen.count > 0 ? "; " : "", told);
            text_list_add(&seen, told);
            value = of;
        }
        free(dumped);
    }
    value = seen.count > 1 ? json_string(text.bytes) : json_incref(value);
    text_list_free(&seen);
    text_free(&text);
    return value;
}

static json_t *machine_json(const shard_set *set)
{
    json_t *joined = json_object(), *machine = json_object_get(set->folders[0].manifest, "machine");
    const char *name;
    json_t *value;
    json_object_foreach(machine, name, value)
        json_object_set_new(joined, name, machine_fact(set, name));
    return joined;
}

/* Each item of the lists once. */
static json_t *list_json(const shard_set *set, const char *name)
{
    json_t *joined = json_array(), *item;
    fm_text_index seen = { 0 };
    size_t at;
    for (size_t i = 0; i < set->count; i++)
        json_array_foreach(json_object_get(set->folders[i].manifest, name), at, item)
        {
            char *text = json_dumps(item, JSON_COMPACT | JSON_SORT_KEYS | JSON_ENCODE_ANY);
            const size_t count = json_array_size(joined);
            if (text != NULL && text_index_add(&seen, text, count) == count)
                json_array_append(joined, item);
            free(text);
        }
    text_index_free(&seen);
    return joined;
}

/* The members of all objects; of one that several have, the first. */
static json_t *object_json(const shard_set *set, const char *name)
{
    json_t *joined = json_object();
    for (size_t i = 0; i < set->count; i++) {
        json_t *object = json_object_get(set->folders[i].manifest, name);
        if (object != NULL)
            json_object_update_missing(joined, object);
    }
    return joined;
}

static json_t *shards_json(const shard_set *set)
{
    static const char *const copied[] = { "run_id", "command", "started",
                                          "ended",  "machine", "devices" };
    json_t *shards = json_array();
    for (size_t i = 0; i < set->count; i++) {
        const shard_folder *of = &set->folders[i];
        json_t *shard = json_pack("{s:i, s:s, s:I}", "index", (int)of->index, "folder", of->path,
                                  "rows", (json_int_t)of->finished);
        for (size_t j = 0; j < sizeof copied / sizeof copied[0]; j++) {
            json_t *value = json_object_get(of->manifest, copied[j]);
            if (value != NULL)
                json_object_set(shard, copied[j], value);
        }
        json_array_append_new(shards, shard);
    }
    return shards;
}

static json_t *merged_json(const shard_set *set, const fm_text_list *missing)
{
    const shard_folder *first = &set->folders[0];
    json_t *sentences = json_array();
    for (size_t i = 0; i < missing->count; i++)
        json_array_append_new(sentences, json_string(missing->items[i]));
    return json_pack("{s:s, s:i, s:I, s:o, s:o}", "plan", first->plan, "count", (int)first->count,
                     "cases", (json_int_t)set->cases->row_count, "missing", sentences, "shards",
                     shards_json(set));
}

/* Of the plan and the runs, so that the same merge has the same. */
static void make_run_id(char run_id[17], const shard_set *set)
{
    uint64_t hash = XXH64(set->folders[0].plan, 16, 0);
    for (size_t i = 0; i < set->count; i++)
        hash = XXH64(set->folders[i].run_id, 16, hash);
    snprintf(run_id, 17, "%016llx", (unsigned long long)hash);
}

static json_t *manifest_json(const shard_set *set, const fm_merge_desc *desc,
                             const fm_text_list *missing, bool is_ended)
{
    static const char *const same[] = {
        "schema", "fragmark", "git_commit", "seed",      "launches",
        "frames", "warmup",   "validation", "no_timers", "figures"
    };
    static const char *const lists[] = { "devices", "scenes", "codes" };
    static const char *const objects[] = { "methods", "modelled", "meshes" };
    char run_id[17];
    const char *ended = extreme(set, "ended", true);
    make_run_id(run_id, set);
    json_t *manifest = json_object();
    for (size_t i = 0; i < sizeof same / sizeof same[0]; i++) {
        json_t *value = json_object_get(set->folders[0].manifest, same[i]);
        if (value != NULL)
            json_object_set(manifest, same[i], value);
    }
    json_object_set_new(manifest, "run_id", json_string(run_id));
    json_object_set_new(manifest, "command", json_string(desc->command));
    json_object_set_new(manifest, "started", json_string(extreme(set, "started", false)));
    if (is_ended && missing->count == 0 && ended[0] != '\0')
        json_object_set_new(manifest, "ended", json_string(ended));
    json_object_set_new(manifest, "machine", machine_json(set));
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++)
        json_object_set_new(manifest, lists[i], list_json(set, lists[i]));
    for (size_t i = 0; i < sizeof objects / sizeof objects[0]; i++)
        json_object_set_new(manifest, objects[i], object_json(set, objects[i]));
    json_object_set_new(manifest, "merged", merged_json(set, missing));
    return manifest;
}

fm_status merged_manifest_write(const shard_set *set, const fm_merge_desc *desc,
                                const fm_text_list *missing, bool is_ended, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    json_t *manifest = manifest_json(set, desc, missing, is_ended);
    char *text = manifest != NULL ? json_dumps(manifest, JSON_INDENT(2)) : NULL;
    fm_status status = path_join(path, desc->directory, "manifest.json", err);
    if (status == FM_OK)
        status = text != NULL ? text_write_file(path, text, strlen(text), err)
                              : fm_fail(err, FM_NO_MEMORY, "%s: cannot be put together", path);
    free(text);
    json_decref(manifest);
    return status;
}

static fm_status expect_own(const char *directory, const char *plan, fm_error *err)
{
    json_t *manifest = NULL;
    fm_error below = { 0 };
    const bool is_read = json_read_object(&manifest, directory, "manifest.json", &below) == FM_OK;
    const char *of = is_read ? text_of(json_object_get(manifest, "merged"), "plan") : "";
    const fm_status status =
        strcmp(of, plan) == 0
            ? FM_OK
            : fm_fail(err, FM_INVALID, "%s: holds something else%s; name a new folder", directory,
                      of[0] != '\0' ? ", a merge of another plan" : "");
    json_decref(manifest);
    return status;
}

fm_status merged_manifest_expect(const char *directory, const char *plan, fm_error *err)
{
    fm_error below = { 0 };
    if (staging_expect_free(directory, &below) == FM_OK)
        return FM_OK;
    const fm_status status = path_is_folder(directory, &below);
    return status == FM_OK ? expect_own(directory, plan, err)
                           : fm_fail(err, FM_INVALID, "%s", below.message);
}
