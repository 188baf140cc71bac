#include "pack_papers.h"

#include <stdlib.h>
#include <string.h>

#include "base/path.h"
#include "base/text.h"
#include "bundle/items_json.h"
#include "code/code_json.h"
#include "pack.h"
#include "parent/manifest.h"

static const char *text_of(const json_t *object, const char *name)
{
    const char *text = json_string_value(json_object_get(object, name));
    return text != NULL ? text : "unknown";
}

/* Those of the shards, where it is a merge's. */
static void add_commands(fm_text *text, const json_t *manifest)
{
    const json_t *shard, *shards = json_object_get(json_object_get(manifest, "merged"), "shards");
    size_t i;
    json_array_foreach(shards, i, shard) text_add(text, "  %s\n", text_of(shard, "command"));
    text_add(text, "  %s\n", text_of(manifest, "command"));
}

static void add_facts(fm_text *text, const char *title, const json_t *object)
{
    const char *name;
    json_t *value;
    text_add(text, "\n%s\n", title);
    json_object_foreach((json_t *)(uintptr_t)object, name, value)
    {
        char *dumped = json_dumps(value, JSON_ENCODE_ANY);
        text_add(text, "  %-14s%s\n", name,
                 json_is_string(value) ? json_string_value(value)
                 : dumped != NULL      ? dumped
                                       : "");
        free(dumped);
    }
}

static void add_devices(fm_text *text, const json_t *manifest)
{
    const json_t *device;
    size_t i;
    text_add(text, "\nDevices:\n");
    json_array_foreach(json_object_get(manifest, "devices"), i, device)
        text_add(text, "  %s: %s, driver %s\n", text_of(device, "selector"),
                 text_of(device, "name"), text_of(device, "driver"));
}

static void add_scenes(fm_text *text, const json_t *manifest)
{
    const json_t *scene;
    size_t i;
    text_add(text, "\nScenes, with the hash of all that they are made of:\n");
    json_array_foreach(json_object_get(manifest, "scenes"), i, scene)
        text_add(text, "  %s  %s\n", text_of(scene, "hash"), text_of(scene, "name"));
}

/* Each file that rows were measured by, once. */
static void add_code(fm_text *text, const json_t *manifest)
{
    fm_text_list told = { 0 };
    const json_t *json;
    char digits[17], line[256];
    size_t i;
    text_add(text, "\nPlugins and GLSL, with their XXH3 (of a floor: what ratios rest on):\n");
    json_array_foreach(json_object_get(manifest, "codes"), i, json)
    {
        fm_code code;
        const bool is_code = code_from_json(&code, json);
        for (size_t j = 0; is_code && j < code.count; j++) {
            const fm_code_file *file = &code.files[j];
            code_digits(digits, file->hash);
            snprintf(line, sizeof line, "%s  %.200s", digits, file->name);
            if (text_list_has(&told, line))
                continue;
            text_add(text, "  %s\n", line);
            text->failed = text->failed || !text_list_add(&told, line);
        }
        code_free(&code);
    }
    text_list_free(&told);
}

fm_status pack_write_readme(const char *path, const char *name, const json_t *manifest,
                            fm_error *err)
{
    fm_text text = { 0 };
    text_add(&text,
             "%s: results of fragmark %s (commit %s), started %s.\n"
             "\n"
             "  fragmark verify DIR      are all files as they were packed, and what is another "
             "here?\n"
             "  fragmark report DIR      draws charts and report.html again\n"
             "\n"
             "Measured by, with specs/ for what they name:\n",
             name, text_of(manifest, "fragmark"), text_of(manifest, "git_commit"),
             text_of(manifest, "started"));
    add_commands(&text, manifest);
    add_facts(&text, "On:", json_object_get(manifest, "machine"));
    add_devices(&text, manifest);
    add_scenes(&text, manifest);
    add_code(&text, manifest);
    const fm_status status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                                         : text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}

static json_t *commands_json(const json_t *manifest)
{
    json_t *commands = json_array();
    const json_t *shard, *shards = json_object_get(json_object_get(manifest, "merged"), "shards");
    size_t i;
    json_array_foreach(shards, i, shard)
        json_array_append_new(commands, json_string(text_of(shard, "command")));
    json_array_append_new(commands, json_string(text_of(manifest, "command")));
    return commands;
}

/* Where the files were is nobody's business. */
static json_t *listed_json(const bundle_items *items)
{
    json_t *files = items_json(items), *file;
    size_t i;
    json_array_foreach(files, i, file) json_object_del(file, "from");
    return files;
}

fm_status pack_write_list(char id[17], const char *folder, const bundle_items *items,
                          const json_t *manifest, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, folder, FM_PACK_FILE, err);
    json_t *list = json_pack("{s:i, s:s, s:s, s:s, s:o, s:o}", "pack", 1, "fragmark", FM_VERSION,
                             "git_commit", manifest_commit(), "run_id", text_of(manifest, "run_id"),
                             "commands", commands_json(manifest), "files", listed_json(items));
    char *text = list != NULL ? json_dumps(list, JSON_INDENT(1)) : NULL;
    if (status == FM_OK)
        status = text != NULL ? text_write_file(path, text, strlen(text), err)
                              : fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        code_digits(id, code_hash_file(path));
    free(text);
    json_decref(list);
    return status;
}
