#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "cache/cache.h"
#include "cli.h"
#include "parent/machine.h"
#include "scene/scene_file.h"

enum { KEY_JSON = 512, DEVICES_MAX = 32 };

static const struct argp_option options[] = {
    { "json", KEY_JSON, NULL, 0, "as JSON", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

static error_t parse(int key, char *text, struct argp_state *state)
{
    bool *json = state->input;
    (void)text;
    switch (key) {
    case KEY_JSON:
        *json = true;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .doc = "Says what this machine can run, and how to fix what it cannot."
           "\v"
           "Opens every device, so that it also finds drivers that are there and broken.\n"
           "\n" CLI_EXIT_CODES,
};

/* What brings a device that is missing. */
static const char *remedy(const char *device)
{
    static const struct {
        const char *device, *text;
    } remedies[] = {
        { "vulkan", "apt install mesa-vulkan-drivers (runs on the CPU), or your GPU's own driver" },
        { "osmesa", "apt install libosmesa6" },
    };
    for (size_t i = 0; i < sizeof remedies / sizeof remedies[0]; i++)
        if (strcmp(device, remedies[i].device) == 0)
            return remedies[i].text;
    return "";
}

static json_t *samples_json(uint32_t mask)
{
    json_t *list = json_array();
    for (int bit = 0; bit < 32; bit++)
        if ((mask & 1u << bit) != 0)
            json_array_append_new(list, json_integer(bit));
    return list;
}

static json_t *features_json(const fm_device_caps *caps)
{
    return json_pack("{s:b, s:b, s:b, s:b, s:b}", "int64_atomics",
                     (caps->features & FM_FEATURE_INT64_ATOMICS) != 0, "interlock",
                     (caps->features & FM_FEATURE_INTERLOCK) != 0, "stencil_export",
                     (caps->features & FM_FEATURE_STENCIL_EXPORT) != 0, "buffer_address",
                     (caps->features & FM_FEATURE_BUFFER_ADDRESS) != 0, "subgroup_ballot",
                     (caps->features & FM_FEATURE_SUBGROUP_BALLOT) != 0);
}

static json_t *caps_json(const char *selector, const fm_device_caps *caps)
{
    return json_pack(
        "{s:s, s:s, s:s, s:s, s:b, s:b, s:o, s:o, s:o, s:i, s:i, s:i, s:I, s:I, s:i, s:I, s:I, "
        "s:f}",
        "selector", selector, "name", caps->name, "driver", caps->driver, "api", caps->api,
        "is_software", (int)caps->is_software, "has_gpu_clock", (int)caps->has_gpu_clock,
        "features", features_json(caps), "colour_samples", samples_json(caps->colour_samples),
        "depth_samples", samples_json(caps->depth_samples), "max_targets", (int)caps->max_targets,
        "subgroup_size", (int)caps->subgroup_size, "loop_limit", (int)caps->loop_limit,
        "storage_range_bytes", (json_int_t)caps->storage_range_bytes, "buffer_max_bytes",
        (json_int_t)caps->buffer_max_bytes, "image_layers", (int)caps->image_layers,
        "image_max_bytes", (json_int_t)caps->image_max_bytes, "memory_bytes",
        (json_int_t)caps->memory_bytes, "timestamp_ns", caps->timestamp_ns);
}

static json_t *device_json(const fm_device_list *devices, const char *selector)
{
    fm_device *device = NULL;
    fm_error err = { 0 };
    const fm_device_desc desc = { 0 };
    if (device_open(&device, devices, selector, &desc, &err) != FM_OK)
        return json_pack("{s:s, s:s}", "selector", selector, "error", err.message);
    json_t *row = caps_json(selector, &device->caps);
    device_close(device);
    return row;
}

static json_t *devices_json(const fm_device_list *devices)
{
    json_t *rows = json_array();
    for (size_t d = 0; d < devices->count; d++) {
        const fm_device_ops *ops = devices->devices[d];
        fm_device_entry entries[DEVICES_MAX];
        size_t count = DEVICES_MAX;
        fm_error err = { 0 };
        const fm_status status = ops->list(entries, &count, &err);
        for (size_t i = 0; status == FM_OK && i < count && i < DEVICES_MAX; i++)
            json_array_append_new(rows, device_json(devices, entries[i].selector));
        if (status != FM_OK || count == 0)
            json_array_append_new(rows,
                                  json_pack("{s:s, s:s, s:s}", "selector", ops->name, "error",
                                            err.message[0] != '\0' ? err.message : "no device",
                                            "remedy", remedy(ops->name)));
    }
    return rows;
}

static bool has_validation_layer(void)
{
    static const char *const folders[] = { "/usr/share", "/etc", "/usr/local/share" };
    char path[256];
    for (size_t i = 0; i < sizeof folders / sizeof folders[0]; i++) {
        snprintf(path, sizeof path, "%s/vulkan/explicit_layer.d/VkLayer_khronos_validation.json",
                 folders[i]);
        if (access(path, R_OK) == 0)
            return true;
    }
    return getenv("VK_LAYER_PATH") != NULL;
}

static json_t *machine_facts(void)
{
    fm_machine machine;
    machine_describe(&machine);
    return json_pack("{s:s, s:i, s:I, s:s, s:s, s:s, s:s}", "cpu", machine.cpu, "cores",
                     (int)machine.cores, "memory_bytes", (json_int_t)machine.memory_bytes, "os",
                     machine.os, "kernel", machine.kernel, "compiler", machine.compiler, "governor",
                     machine.governor);
}

static json_t *methods_facts(void)
{
    fm_plugin_list plugins = { 0 };
    fm_error err = { 0 };
    json_t *refused = json_array(), *folder = NULL;
    int opened = 0;
    const fm_text_list none = { 0 };
    fm_status status = cli_find_plugins(&plugins, &none, &err);
    if (status == FM_OK)
        status = plugin_list_read_all(&plugins, &err);
    if (status != FM_OK)
        json_array_append_new(refused, json_string(err.message));
    for (size_t i = 0; i < plugins.count; i++) {
        const fm_plugin_entry *entry = &plugins.entries[i];
        opened += entry->plugin != NULL;
        if (entry->plugin == NULL)
            json_array_append_new(refused, json_string(entry->error.message));
        else if (folder == NULL)
            folder = json_string(entry->plugin->folder);
    }
    plugin_list_close(&plugins);
    return json_pack("{s:i, s:o?, s:o}", "count", opened, "first", folder, "refused", refused);
}

static json_t *scenes_facts(void)
{
    fm_scene_names scenes = { 0 };
    fm_error err = { 0 };
    if (scene_names_list(&scenes, &err) != FM_OK)
        return json_pack("{s:i, s:s}", "count", 0, "error", err.message);
    json_t *facts = json_pack("{s:i, s:s?}", "count", (int)scenes.count, "first",
                              scenes.count > 0 ? scenes.paths[0] : NULL);
    scene_names_free(&scenes);
    return facts;
}

static json_t *figures_facts(void)
{
    fm_figure_list list = { 0 };
    fm_error err = { 0 };
    if (figures_list(&list, &err) != FM_OK)
        return json_pack("{s:i, s:s}", "count", 0, "error", err.message);
    json_t *facts = json_pack("{s:i, s:s?}", "count", (int)list.count, "first",
                              list.count > 0 ? list.figures[0].path : NULL);
    figures_free(&list);
    return facts;
}

/* By kind, what there is of each. */
static json_t *cache_facts(void)
{
    char folder[FM_PATH_MAX_BYTES];
    json_t *kinds = json_object();
    cache_find_folder(folder);
    for (int kind = 0; kind < CACHE_KIND_COUNT && folder[0] != '\0'; kind++) {
        const cache_size size = cache_measure(folder, (cache_kind)kind);
        json_object_set_new(kinds, cache_kinds[kind].name,
                            json_pack("{s:I, s:I, s:I}", "files", (json_int_t)size.files, "bytes",
                                      (json_int_t)size.bytes, "most_bytes",
                                      (json_int_t)cache_kinds[kind].most_bytes));
    }
    return json_pack("{s:s, s:o}", "folder", folder, "kinds", kinds);
}

static json_t *facts_json(const fm_device_list *devices)
{
    char program[FM_PATH_MAX_BYTES] = "", report[FM_PATH_MAX_BYTES];
    json_t *methods = methods_facts(); /* before drivers have threads */
    if (data_program_folder(program, NULL) != FM_OK)
        snprintf(program, sizeof program, "unknown");
    return json_pack("{s:s, s:o, s:o, s:b, s:s, s:o, s:o, s:o, s:o, s:s?}", "fragmark", FM_VERSION,
                     "machine", machine_facts(), "devices", devices_json(devices),
                     "validation_layer", (int)has_validation_layer(), "program", program, "methods",
                     methods, "scenes", scenes_facts(), "figures", figures_facts(), "cache",
                     cache_facts(), "report", report_find(report) ? report : NULL);
}

static const char *text_of(const json_t *object, const char *key)
{
    const char *text = json_string_value(json_object_get(object, key));
    return text != NULL ? text : "";
}

static double gib_of(const json_t *object, const char *key)
{
    return json_number_value(json_object_get(object, key)) / (1024.0 * 1024.0 * 1024.0);
}

static void write_list(FILE *out, const json_t *list)
{
    size_t index;
    const json_t *item;
    json_array_foreach(list, index, item)
        fprintf(out, "%s%lld", index > 0 ? " " : "", (long long)json_integer_value(item));
}

static void write_device(FILE *out, const json_t *device)
{
    const char *name;
    json_t *has;
    if (json_object_get(device, "error") != NULL) {
        fprintf(out, "%s\n  cannot be used: %s\n", text_of(device, "selector"),
                text_of(device, "error"));
        if (text_of(device, "remedy")[0] != '\0')
            fprintf(out, "  to fix it: %s\n", text_of(device, "remedy"));
        return;
    }
    fprintf(out, "%s\n  %s; %s; %s%s\n", text_of(device, "selector"), text_of(device, "name"),
            text_of(device, "driver"), text_of(device, "api"),
            json_is_true(json_object_get(device, "is_software")) ? "; runs on the CPU" : "");
    json_object_foreach(json_object_get(device, "features"), name, has)
        fprintf(out, "  %-22s %s\n", name, json_is_true(has) ? "yes" : "no");
    fprintf(out, "  %-22s ", "samples, colour");
    write_list(out, json_object_get(device, "colour_samples"));
    fprintf(out, "\n  %-22s ", "samples, depth");
    write_list(out, json_object_get(device, "depth_samples"));
    fprintf(out, "\n  %-22s %lld\n", "subgroup size",
            (long long)json_integer_value(json_object_get(device, "subgroup_size")));
    fprintf(out, "  %-22s %.2f GiB bound", "largest buffer", gib_of(device, "storage_range_bytes"));
    if (gib_of(device, "buffer_max_bytes") > 0.0)
        fprintf(out, ", %.2f GiB by address", gib_of(device, "buffer_max_bytes"));
    fputc('\n', out);
    const double tick_ns = json_number_value(json_object_get(device, "timestamp_ns"));
    if (tick_ns > 0.0)
        fprintf(out, "  %-22s %g ns a tick\n", "timers", tick_ns);
    else
        fprintf(out, "  %-22s none\n", "timers");
}

static void write_machine(FILE *out, const json_t *machine)
{
    fprintf(out, "machine\n  %s, %lld cores, %.1f GiB\n  %s, %s\n  governor %s%s\n  built by %s\n",
            text_of(machine, "cpu"),
            (long long)json_integer_value(json_object_get(machine, "cores")),
            gib_of(machine, "memory_bytes"), text_of(machine, "os"), text_of(machine, "kernel"),
            text_of(machine, "governor"),
            strcmp(text_of(machine, "governor"), "performance") == 0 ||
                    strcmp(text_of(machine, "governor"), "unknown") == 0
                ? ""
                : " (cpupower frequency-set -g performance makes times steadier)",
            text_of(machine, "compiler"));
}

static void write_found(FILE *out, const json_t *facts, const char *what)
{
    const json_t *found = json_object_get(facts, what);
    const long long count = (long long)json_integer_value(json_object_get(found, "count"));
    size_t index;
    const json_t *message;
    fprintf(out, "  %-9s %lld%s%s%s\n", what, count, count > 0 ? ", the first: " : "",
            text_of(found, "first"), text_of(found, "error"));
    json_array_foreach(json_object_get(found, "refused"), index, message)
        fprintf(out, "    refused: %s\n", json_string_value(message));
}

static void write_cache(FILE *out, const json_t *cache)
{
    const char *name;
    json_t *kind;
    if (text_of(cache, "folder")[0] == '\0') {
        fprintf(out, "  cache     none\n");
        return;
    }
    fprintf(out, "  cache     %s (may be removed at any time)\n", text_of(cache, "folder"));
    json_object_foreach(json_object_get(cache, "kinds"), name, kind)
        fprintf(out, "    %-11s %lld files, %.1f of at most %.0f MiB\n", name,
                (long long)json_integer_value(json_object_get(kind, "files")),
                1024.0 * gib_of(kind, "bytes"), 1024.0 * gib_of(kind, "most_bytes"));
}

static void write_facts(FILE *out, const json_t *facts)
{
    size_t index;
    const json_t *device;
    fprintf(out, "fragmark %s\n  program   %s\n", text_of(facts, "fragmark"),
            text_of(facts, "program"));
    write_found(out, facts, "methods");
    write_found(out, facts, "scenes");
    write_found(out, facts, "figures");
    write_cache(out, json_object_get(facts, "cache"));
    if (text_of(facts, "report")[0] != '\0')
        fprintf(out, "  report    %s\n", text_of(facts, "report"));
    else
        fprintf(out, "  report    none: %s\n", report_missing());
    write_machine(out, json_object_get(facts, "machine"));
    json_array_foreach(json_object_get(facts, "devices"), index, device) write_device(out, device);
    if (json_is_true(json_object_get(facts, "validation_layer")))
        fprintf(out, "validation layer installed\n");
    else
        fprintf(out, "validation layer missing; to fix it: apt install vulkan-validationlayers\n");
}

static bool can_measure(const json_t *facts)
{
    size_t index;
    const json_t *device;
    json_array_foreach(
        json_object_get(facts, "devices"), index,
        device) if (json_object_get(device, "error") == NULL &&
                    strncmp(text_of(device, "selector"), "dummy", 5) !=
                        0) return json_integer_value(json_object_get(json_object_get(facts,
                                                                                     "methods"),
                                                                     "count")) > 0;
    return false;
}

int cli_doctor(const fm_cli *cli, int argc, char **argv)
{
    bool json = false;
    argp_parse(&argp, argc, argv, 0, NULL, &json);
    json_t *facts = facts_json(cli->devices);
    const int code = can_measure(facts) ? CLI_DONE : CLI_NOTHING;
    if (json)
        cli_print_json(cli, json_incref(facts));
    else
        write_facts(cli->out, facts);
    json_decref(facts);
    return code;
}
