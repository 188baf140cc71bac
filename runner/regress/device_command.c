/* `fragmark calibrate device` */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "calibrate/calibrate.h"
#include "commands.h"
#include "parent/machine.h"
#include "plugin/plugin.h"

enum { KEY_JSON = 700, KEY_DEVICE, KEY_FOLDER, ENTRIES_MAX = 32 };

typedef struct device_arguments {
    const fm_cli *cli;
    fm_text_list devices, folders; /* none: all devices */
    const char *file;              /* -o; NULL: that of the state folder */
    bool json;
} device_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    device_arguments *given = state->input;
    fm_error err = { 0 };
    switch (key) {
    case KEY_JSON:
        given->json = true;
        return 0;
    case KEY_DEVICE:
        if (names_add_split(&given->devices, text, &err) != FM_OK)
            argp_error(state, "--device: %s", err.message);
        return 0;
    case KEY_FOLDER:
        if (names_add(&given->folders, text, &err) != FM_OK)
            cli_argp_fail(state, &err);
        return 0;
    case 'o':
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "-o: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->file = text;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "device", KEY_DEVICE, "D,...", 0,
      "which, as `fragmark list devices` names them; all that draw and have a clock", 0 },
    { "output", 'o', "FILE", 0,
      "where it is kept; $XDG_STATE_HOME/fragmark/devices.json, or the same in ~/.local/state: "
      "what "
      "run reads",
      0 },
    { "plugin-dir", KEY_FOLDER, "DIR", 0, "look for the floor here first", 0 },
    { "json", KEY_JSON, NULL, 0, "print JSON instead of lines", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .doc =
        "What can this device do at most? Measures how fast it copies large buffers and adds to "
        "words that many invocations share, or none; what a compute pass and a timer of nothing "
        "cost; and how many fragments it rasterises for the floor, which keeps none. `run` takes "
        "from there the columns bound_ms, times_bound and limited_by."
        "\v"
        "Each value is the median of up to 11 repeats, with its interval, by the device's clock; "
        "all take a few seconds. A value that the device cannot have is left out.\n"
        "\n"
        "Calibrate each device once, while the machine does nothing else, and again when the "
        "driver has changed. A file holds many devices, told apart by name, driver and "
        "processors.\n"
        "\n"
        "Examples:\n"
        "  fragmark calibrate device\n"
        "  fragmark calibrate device --device vulkan:0 --json\n"
        "\n"
        "Exit codes: 0 done; 2 usage error, nothing was measured; 3 nothing could be measured; 5 "
        "it cannot be kept.",
};

static void tell_value(FILE *out, const fm_limit_info *info, const fm_interval *value)
{
    const bool is_time = strcmp(info->unit, "ns") == 0;
    const double scale = is_time ? 1.0 : 1e-9;
    const char *unit = is_time ? "ns" : strcmp(info->unit, "B/s") == 0 ? "GB/s" : "10^9/s";
    if (isnan(value->median))
        return;
    fprintf(out, "  %-32s %10.4g %-6s", info->title, scale * value->median, unit);
    if (interval_is_known(value))
        fprintf(out, " (%.4g to %.4g)", scale * value->low, scale * value->high);
    fprintf(out, "\n");
}

static void tell(FILE *out, const fm_device_limits *limits)
{
    fprintf(out, "%s, %s\n", limits->key.device_name, limits->key.driver);
    for (int i = 0; i < FM_LIMIT_COUNT; i++)
        tell_value(out, &fm_limits[i], &limits->values[i]);
}

typedef struct calibrating {
    const device_arguments *given;
    fm_plugin_list plugins;
    const fm_plugin *floor;
    fm_limits_list kept; /* all of the file */
    json_t *told;        /* --json */
    fm_machine machine;
    uint32_t measured;
} calibrating;

static fm_status measure_opened(calibrating *of, fm_device *device, fm_error *err)
{
    fm_device_limits limits;
    const calibrate_desc desc = { .device = device,
                                  .floor = of->floor->method,
                                  .folders = { .method = of->floor->folder,
                                               .common = of->plugins.common_folder } };
    fm_status status = calibrate_device(&limits, &desc, err);
    limits.key.cores = of->machine.cores;
    snprintf(limits.key.cpu, sizeof limits.key.cpu, "%s", of->machine.cpu);
    if (status == FM_OK)
        status = limits_keep(&of->kept, &limits, err);
    if (status != FM_OK)
        return status;
    of->measured++;
    if (of->given->json)
        json_array_append_new(of->told, limits_json(&limits));
    else
        tell(of->given->cli->out, &limits);
    return FM_OK;
}

/* A device that was not asked for by name may be one that nobody can calibrate. */
static fm_status measure(calibrating *of, const char *name, bool is_asked_for, fm_error *err)
{
    fm_device *device = NULL;
    FILE *talk = of->given->cli->talk;
    fm_status status =
        device_open(&device, of->given->cli->devices, name, &(fm_device_desc){ 0 }, err);
    if (status == FM_OK && device->caps.timestamp_ns == 0.0)
        status = fm_refuse(err, FM_REASON_FEATURE, "%s has no clock", device->caps.name);
    if (status == FM_OK && strcmp(device->caps.api, "none") == 0)
        status = fm_refuse(err, FM_REASON_FEATURE, "%s draws nothing", device->caps.name);
    if (status == FM_OK)
        status = measure_opened(of, device, err);
    device_close(device);
    if (status == FM_OK || is_asked_for)
        return status;
    fprintf(talk, "%s: left out: %s\n", name, err->message);
    return FM_OK;
}

static fm_status measure_all(calibrating *of, fm_error *err)
{
    const fm_device_list *list = of->given->cli->devices;
    fm_status status = FM_OK;
    for (size_t d = 0; d < list->count && status == FM_OK; d++) {
        fm_device_entry entries[ENTRIES_MAX];
        size_t count = ENTRIES_MAX;
        if ((device_feeds(list->devices[d]) & FM_FEED_RASTER) == 0 ||
            list->devices[d]->list(entries, &count, NULL) != FM_OK)
            continue;
        for (size_t i = 0; i < count && status == FM_OK; i++)
            status = measure(of, entries[i].selector, false, err);
    }
    return status;
}

static fm_status measure_named(calibrating *of, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < of->given->devices.count && status == FM_OK; i++)
        if (device_find(of->given->cli->devices, of->given->devices.items[i]) == NULL)
            status =
                fm_fail(err, FM_INVALID, "--device %s: no such device; `fragmark list devices`",
                        of->given->devices.items[i]);
    for (size_t i = 0; i < of->given->devices.count && status == FM_OK; i++)
        status = measure(of, of->given->devices.items[i], true, err);
    return status;
}

static fm_status begin(calibrating *of, char path[FM_PATH_MAX_BYTES], fm_error *err)
{
    fm_status status = FM_OK;
    machine_describe(&of->machine);
    if (of->given->file == NULL)
        status = limits_path(path, err);
    else
        snprintf(path, FM_PATH_MAX_BYTES, "%s", of->given->file);
    if (status == FM_OK)
        status = limits_read(&of->kept, path, err);
    if (status == FM_OK)
        status = cli_find_plugins(&of->plugins, &of->given->folders, err);
    if (status == FM_OK)
        status = plugin_list_floor(&of->floor, &of->plugins, FM_FEED_RASTER, err);
    return status;
}

/* What was measured before a device failed is kept, too. */
static int finish(calibrating *of, const char *path, fm_status status, const fm_error *failure)
{
    const fm_cli *cli = of->given->cli;
    fm_error err = { 0 };
    if (of->measured > 0 && limits_write(path, &of->kept, &err) != FM_OK) {
        cli_fail(cli, &err);
        return CLI_INCOMPLETE;
    }
    if (of->measured > 0)
        fprintf(cli->talk, "kept in %s\n", path);
    if (of->given->json)
        cli_print_json(cli, json_incref(of->told));
    if (status == FM_INVALID)
        return cli_fail(cli, failure);
    if (status != FM_OK)
        cli_fail(cli, failure);
    return status == FM_OK && of->measured > 0 ? CLI_DONE : CLI_NOTHING;
}

int regress_calibrate_device(const fm_cli *cli, int argc, char **argv)
{
    char path[FM_PATH_MAX_BYTES];
    fm_error err = { 0 };
    device_arguments given = { .cli = cli };
    calibrating of = { .given = &given, .told = json_array() };
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    fm_status status = begin(&of, path, &err);
    int code = status == FM_OK ? CLI_DONE : cli_fail(cli, &err);
    if (status == FM_OK) {
        status = given.devices.count > 0 ? measure_named(&of, &err) : measure_all(&of, &err);
        code = finish(&of, path, status, &err);
    }
    json_decref(of.told);
    limits_free(&of.kept);
    plugin_list_close(&of.plugins);
    text_list_free(&given.devices);
    text_list_free(&given.folders);
    return code;
}
