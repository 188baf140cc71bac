#include "differences.h"

#include <stdio.h>
#include <string.h>

#include "code/code_json.h"
#include "code/code_now.h"
#include "parent/machine.h"
#include "parent/manifest.h"
#include "scene/scene_file.h"

enum { SENTENCE_BYTES = 2048 };

typedef struct finding {
    fm_text_list *list;
    const json_t *manifest;
    const fm_plugin_list *plugins;
    bool failed;
} finding;

static void add(finding *all, const char *sentence)
{
    if (!text_list_has(all->list, sentence) && !text_list_add(all->list, sentence))
        all->failed = true;
}

static void compare(finding *all, const char *what, const char *then, const char *now)
{
    char sentence[SENTENCE_BYTES];
    if (strcmp(then, now) == 0)
        return;
    snprintf(sentence, sizeof sentence, "%s: %.800s; here %.800s", what, then, now);
    add(all, sentence);
}

static const char *text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text != NULL ? text : "unknown";
}

/* ID of ID.so, of the method or of the floor; "": none was read. */
static void plugin_of(char id[64], const fm_code *code, fm_code_owner owner)
{
    id[0] = '\0';
    for (size_t i = 0; i < code->count; i++)
        if (code->files[i].owner == owner && code_file_is_plugin(&code->files[i]))
            snprintf(id, 64, "%.*s", (int)strcspn(code->files[i].name, "."), code->files[i].name);
}

static const char *path_of(const finding *all, const char *id)
{
    const fm_plugin_entry *entry = id[0] != '\0' ? plugin_list_find(all->plugins, id) : NULL;
    return entry != NULL ? entry->path : "";
}

static void compare_code(finding *all, const fm_code *then, uint64_t program)
{
    char method[64], floor[64], sentence[SENTENCE_BYTES];
    fm_code now = { 0 };
    fm_text_list files = { 0 };
    plugin_of(method, then, FM_CODE_OF_METHOD);
    plugin_of(floor, then, FM_CODE_OF_FLOOR);
    const fm_code_places places = { .plugins = { [FM_CODE_OF_METHOD] = path_of(all, method),
                                                 [FM_CODE_OF_FLOOR] = path_of(all, floor) },
                                    .common = all->plugins->common_folder,
                                    .program = program };
    if (method[0] != '\0' && path_of(all, method)[0] == '\0') {
        snprintf(sentence, sizeof sentence, "method %s: is not here", method);
        add(all, sentence);
        return;
    }
    code_look_again(&now, then, &places);
    const uint32_t changes = code_changes(&files, then, &now);
    if ((changes & 1u << FM_CODE_PROGRAM) != 0)
        add(all, "program: another build of fragmark");
    for (size_t i = 0; i < files.count; i++) {
        snprintf(sentence, sizeof sentence, "method %s: %.200s is another file here", method,
                 files.items[i]);
        add(all, sentence);
    }
    all->failed = all->failed || now.failed;
    text_list_free(&files);
    code_free(&now);
}

static void compare_codes(finding *all)
{
    const uint64_t program = code_hash_file("/proc/self/exe");
    const json_t *json;
    size_t i;
    json_array_foreach(json_object_get(all->manifest, "codes"), i, json)
    {
        fm_code then;
        if (code_from_json(&then, json))
            compare_code(all, &then, program);
        code_free(&then);
    }
}

/* The scene that this machine would make of the same settings; files are its own. */
static fm_status make_scene(fm_settings *settings, const json_t *scene, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    const char *name;
    json_t *value;
    settings_default(settings);
    fm_status status = scene_file_find(path, text_of(scene, "name"), err);
    if (status == FM_OK)
        status = scene_file_read(settings, path, err);
    json_object_foreach(json_object_get(scene, "settings"), name, value)
    {
        const fm_key *key = key_find(name);
        const bool is_file = strcmp(name, "mesh") == 0 || strcmp(name, "stream") == 0;
        if (status == FM_OK && key != NULL && json_is_string(value) && !is_file)
            status = settings_set(settings, key, json_string_value(value), err);
    }
    return status;
}

static void compare_scene(finding *all, const json_t *scene)
{
    char sentence[SENTENCE_BYTES], hash[17] = "";
    fm_settings settings;
    fm_error err = { 0 };
    const fm_status status = make_scene(&settings, scene, &err);
    if (status == FM_OK)
        settings_scene_hash(hash, &settings);
    if (status == FM_OK && strcmp(hash, text_of(scene, "hash")) == 0)
        return;
    snprintf(sentence, sizeof sentence, "scene %.200s: %.1000s", text_of(scene, "name"),
             status == FM_OK ? "its mesh, its file or its generator is another here" : err.message);
    add(all, sentence);
}

static void compare_machine(finding *all)
{
    const json_t *then = json_object_get(all->manifest, "machine");
    char number[32], here[32];
    fm_machine machine;
    machine_describe(&machine);
    compare(all, "cpu", text_of(then, "cpu"), machine.cpu);
    compare(all, "os", text_of(then, "os"), machine.os);
    compare(all, "kernel", text_of(then, "kernel"), machine.kernel);
    compare(all, "compiler", text_of(then, "compiler"), machine.compiler);
    compare(all, "governor", text_of(then, "governor"), machine.governor);
    const json_t *cores = json_object_get(then, "cores");
    snprintf(number, sizeof number, "%lld", (long long)json_integer_value(cores));
    snprintf(here, sizeof here, "%u", machine.cores);
    if (json_is_integer(cores))
        compare(all, "cores", number, here);
}

fm_status differences_find(fm_text_list *differences, const json_t *manifest,
                           const fm_plugin_list *plugins, fm_error *err)
{
    finding all = { .list = differences, .manifest = manifest, .plugins = plugins };
    const json_t *scene;
    size_t i;
    compare(&all, "version", text_of(manifest, "fragmark"), FM_VERSION);
    compare(&all, "commit", text_of(manifest, "git_commit"), manifest_commit());
    compare_codes(&all);
    json_array_foreach(json_object_get(manifest, "scenes"), i, scene) compare_scene(&all, scene);
    compare_machine(&all);
    return all.failed ? fm_fail(err, FM_NO_MEMORY, "no memory for what differs") : FM_OK;
}
