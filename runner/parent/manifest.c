#include "manifest.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "code/code_json.h"
#include "git_commit.h"
#include "machine.h"
#include "model/family.h"

static json_t *machine_json(const fm_results *results, const char *compiler)
{
    fm_machine machine;
    json_t *mesa = NULL;
    machine_describe(&machine);
    for (size_t i = 0; i < results->plan->count && mesa == NULL; i++) {
        const char *driver = strstr(results->cases[i].device_driver, "Mesa ");
        if (driver != NULL)
            mesa = json_stringn(driver + 5, strcspn(driver + 5, " ;)"));
    }
    return json_pack("{s:s, s:i, s:I, s:s, s:s, s:s, s:s, s:o?}", "cpu", machine.cpu, "cores",
                     (int)machine.cores, "memory_bytes", (json_int_t)machine.memory_bytes, "os",
                     machine.os, "kernel", machine.kernel, "compiler",
                     compiler != NULL ? compiler : machine.compiler, "governor", machine.governor,
                     "mesa", mesa);
}

static bool device_is_listed(const json_t *devices, const char *selector)
{
    size_t index;
    const json_t *device;
    json_array_foreach(devices, index,
                       device) if (strcmp(json_string_value(json_object_get(device, "selector")),
                                          selector) == 0) return true;
    return false;
}

static json_t *devices_json(const fm_results *results)
{
    json_t *devices = json_array();
    for (size_t i = 0; i < results->plan->count; i++) {
        const fm_case_result *result = &results->cases[i];
        const char *selector = results->plan->cases[i].device;
        if (result->device_name[0] == '\0' || device_is_listed(devices, selector))
            continue;
        json_array_append_new(devices, json_pack("{s:s, s:s, s:s, s:s, s:b, s:b}", "selector",
                                                 selector, "name", result->device_name, "driver",
                                                 result->device_driver, "api", result->device_api,
                                                 "is_software", (int)result->is_software,
                                                 "has_gpu_clock", (int)result->has_gpu_clock));
    }
    return devices;
}

/* What `auto` was worked out to, which may differ between cases. */
static void add_worked_out(fm_text *text, const fm_plan *plan, const fm_method_desc *method)
{
    char pair[sizeof(fm_choice) + 3];
    for (size_t i = 0; plan != NULL && i < plan->count; i++) {
        const fm_case *planned = &plan->cases[i];
        if (strcmp(planned->method, method->id) != 0)
            continue;
        for (size_t j = 0; j < planned->choice_count; j++) {
            if ((planned->worked_out & 1u << j) == 0)
                continue;
            snprintf(pair, sizeof pair, " %s=%s", planned->choices[j].name,
                     planned->choices[j].value);
            if (strstr(text->bytes, pair) == NULL)
                text_add(text, "%s", pair);
        }
    }
}

/* "layout=pixel counters=32", as column `options` spells it; an option that was left to the runner
 * has each value that it got, too. */
static json_t *defaults_json(const fm_method_desc *method, const fm_plan *plan)
{
    fm_text text = { 0 };
    for (size_t i = 0; i < FM_MAX_OPTIONS && method->options[i].name != NULL; i++)
        text_add(&text, "%s%s=%s", i > 0 ? " " : "", method->options[i].name,
                 method->options[i].values[0]);
    if (text.bytes != NULL)
        add_worked_out(&text, plan, method);
    json_t *json = json_string(text.bytes != NULL ? text.bytes : "");
    text_free(&text);
    return json;
}

json_t *method_json(const fm_method_desc *method, const fm_plan *plan)
{
    json_t *traits = json_array();
    for (unsigned bit = 0; trait_name(bit) != NULL; bit++)
        if ((method->traits & 1u << bit) != 0)
            json_array_append_new(traits, json_string(trait_name(bit)));
    return json_pack("{s:s, s:s?, s:s?, s:s, s:s, s:b, s:o, s:o}", "title",
                     method->title != NULL ? method->title : method->id, "citation",
                     method->citation, "version", method->version, "family",
                     family_name(method->family), "marker", marker_name(method->marker), "dashed",
                     (int)method->dashed, "traits", traits, "defaults",
                     defaults_json(method, plan));
}

static json_t *methods_json(const fm_results *results)
{
    json_t *methods = json_object();
    for (size_t i = 0; i < results->plan->count; i++) {
        const char *id = results->plan->cases[i].method;
        const fm_plugin_entry *entry = plugin_list_find(results->plugins, id);
        if (entry != NULL && entry->plugin != NULL && json_object_get(methods, id) == NULL)
            json_object_set_new(methods, id, method_json(entry->plugin->method, results->plan));
    }
    return methods;
}

/* What a user's shell hands over may hold any bytes; JSON does not. */
static json_t *text_json(const char *text)
{
    char *copy = strdup(text);
    if (copy == NULL)
        return NULL;
    text_make_utf8(copy);
    json_t *json = json_string(copy);
    free(copy);
    return json;
}

static json_t *scene_json(const fm_case *planned)
{
    char hash[17], value[FM_PATH_MAX_BYTES];
    json_t *settings = json_object();
    settings_scene_hash(hash, &planned->settings);
    for (size_t i = 0; i < fm_key_count; i++) {
        const fm_key *key = &fm_keys[i];
        if (key->scope != FM_SCOPE_SCENE || !key_is_read(key, planned->settings.generator))
            continue;
        settings_text(value, &planned->settings, key);
        json_object_set_new(settings, key->name, json_string(value));
    }
    return json_pack("{s:o, s:s, s:o}", "name", text_json(planned->scene), "hash", hash, "settings",
                     settings);
}

/* Where the executable lay whose workers measured; "codes" has its hash. */
static json_t *program_json(const fm_run_desc *run)
{
    char *path = realpath(run->worker != NULL ? run->worker : "/proc/self/exe", NULL);
    json_t *json = text_json(path != NULL ? path : "");
    free(path);
    return json;
}

/* By hash: each distinct scene once. */
static json_t *scenes_json(const fm_results *results)
{
    json_t *scenes = json_array(), *seen = json_object();
    for (size_t i = 0; i < results->plan->count; i++) {
        char hash[17];
        settings_scene_hash(hash, &results->plan->cases[i].settings);
        if (json_object_get(seen, hash) == NULL) {
            json_object_set_new(seen, hash, json_true());
            json_array_append_new(scenes, scene_json(&results->plan->cases[i]));
        }
    }
    json_decref(seen);
    return scenes;
}

static json_t *modelled_json(const fm_results *results)
{
    json_t *modelled = json_object();
    for (size_t i = 0; i < results->plan->count; i++)
        if (results->cases[i].modelled != NULL)
            json_object_set(modelled, results->plan->cases[i].id, results->cases[i].modelled);
    return modelled;
}

static json_t *figures_json(const char *const *figures)
{
    json_t *list = json_array();
    for (size_t i = 0; figures != NULL && figures[i] != NULL; i++)
        json_array_append_new(list, json_string(figures[i]));
    return list;
}

/* What was read while rows were measured, each content once: what of it differs is told by files.
 */
static json_t *codes_json(const fm_results *results)
{
    json_t *codes = json_array();
    for (size_t i = 0; i < results->codes.count; i++)
        json_array_append_new(codes, code_to_json(&results->codes.codes[i]));
    return codes;
}

/* NULL: the run is of a whole plan. */
static json_t *shard_json(const fm_shard *shard)
{
    return shard->count == 0
               ? NULL
               : json_pack("{s:i, s:i, s:s, s:I, s:s}", "index", (int)shard->index, "count",
                           (int)shard->count, "plan", shard->plan, "cases",
                           (json_int_t)shard->case_count, "reference", shard->reference);
}

/* The widest that a case may stay; NULL: all are launched a fixed number of times. */
static json_t *precision_json(const fm_plan *plan)
{
    double percent = 0.0;
    for (size_t i = 0; i < plan->count; i++)
        percent = fmax(percent, plan->cases[i].settings.precision_percent);
    return percent > 0.0 ? json_real(percent) : NULL;
}

static json_t *manifest_json(const fm_manifest_desc *desc)
{
    const fm_results *results = desc->results;
    const fm_plan *plan = results->plan;
    const fm_run_desc *run = desc->run;
    char ended[32] = "";
    struct tm utc;
    const time_t now = time(NULL);
    gmtime_r(&now, &utc);
    strftime(ended, sizeof ended, "%Y-%m-%dT%H:%M:%SZ", &utc);
    return json_pack(
        "{s:i, s:s, s:s, s:o?, s:s, s:o?, s:I, s:i, s:i, s:i, s:b, s:b, s:b, s:s, s:s?, s:o, s:o, "
        "s:o, "
        "s:o, "
        "s:o, s:o, s:O?, s:o, s:o*, s:o*}",
        "schema", 1, "fragmark", FM_VERSION, "git_commit",
        run->worker_commit != NULL ? run->worker_commit : FM_GIT_COMMIT, "program",
        program_json(run), "run_id", results->run_id, "command",
        run->command != NULL ? text_json(run->command) : NULL, "seed", (json_int_t)plan->seed,
        "launches", (int)plan->launches, "frames", (int)plan->frames, "warmup", (int)plan->warmup,
        "validation", (int)run->validation, "no_timers", (int)run->no_timers, "cache",
        (int)(run->cache != NULL && run->cache[0] != '\0'), "started", desc->started, "ended",
        desc->is_ended ? ended : NULL, "figures", figures_json(run->figures), "machine",
        machine_json(results, run->worker_compiler), "devices", devices_json(results), "methods",
        methods_json(results), "scenes", scenes_json(results), "modelled", modelled_json(results),
        "meshes", results->meshes, "codes", codes_json(results), "shard", shard_json(&plan->shard),
        "precision_percent", precision_json(plan));
}

fm_status manifest_write(const fm_manifest_desc *desc, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    char *text = NULL;
    json_t *manifest = manifest_json(desc);
    fm_status status = path_join(path, desc->run->directory, "manifest.json", err);
    if (status == FM_OK && manifest != NULL)
        text = json_dumps(manifest, JSON_INDENT(2));
    if (status == FM_OK && text == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "%s: cannot be put together", path);
    if (status == FM_OK)
        status = text_write_file(path, text, strlen(text), err);
    free(text);
    json_decref(manifest);
    return status;
}

const char *manifest_commit(void)
{
    return FM_GIT_COMMIT;
}
