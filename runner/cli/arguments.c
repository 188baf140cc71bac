#include <stdlib.h>
#include <string.h>

#include "cli.h"
#include "describe/describe.h"
#include "model/outcome.h"
#include "parent/plan_look.h"
#include "truth/kept_file.h"

enum {
    KEY_METHOD = 256,
    KEY_SCENE,
    KEY_DEVICE,
    KEY_FEED,
    KEY_PLUGINS,
    KEY_SEED,
    KEY_TIMEOUT,
    KEY_MEMORY,
    KEY_NO_IMAGES,
    KEY_NO_CACHE,
    KEY_VALIDATION,
    KEY_NO_TIMERS,
    KEY_NO_REPORT,
    KEY_RETRY,
    KEY_FRESH,
    KEY_KEEP,
    KEY_SHARD,
    KEY_SHARD_REFERENCE,
};

static const struct argp_option selection_options[] = {
    { "method", KEY_METHOD, "A,B", 0, "methods (`fragmark list methods`); all but controls", 0 },
    { "scene", KEY_SCENE, "S,...", 0, "scenes, by name or file; layers", 0 },
    { "device", KEY_DEVICE, "D,...", 0, "devices (`fragmark list devices`); vulkan", 0 },
    { "feed", KEY_FEED, "F,...", 0,
      "raster, compute-layer, compute-pixel, compute-adjacent, triangles, frames; raster", 0 },
    { "axis", 'a', "AXIS=VALUES", 0,
      "values of one axis or of a method's option: k=4,8,16, k=4:64:*2, n=16:64:+16; repeatable",
      0 },
    { "plugin-dir", KEY_PLUGINS, "DIR", 0, "look for methods here first; repeatable", 0 },
    { "seed", KEY_SEED, "N", 0, "of the order of launches", 0 },
    { 0 },
};

static const struct argp_option running_options[] = {
    { "output", 'o', "DIR", 0, "folder of the results; the same one continues a run; out-UTC", 0 },
    { "timeout", KEY_TIMEOUT, "S", 0, "seconds that one launch may take; 600", 0 },
    { "memory-limit", KEY_MEMORY, "BYTES", 0, "address space of one launch: 4G, 512M; none", 0 },
    { "retry", KEY_RETRY, "STATUS,...", 0,
      "rows of an earlier run that have one of these statuses are measured anew: crash, timeout",
      0 },
    { "fresh", KEY_FRESH, NULL, 0,
      "measure rows anew whose program, driver, plugin or shaders changed since they were begun; "
      "without it such a run stops with exit code 7",
      0 },
    { "keep", KEY_KEEP, "WHAT,...", 0,
      "keep of each case, in DIR/kept, what `fragmark dump` shows: fragments (those that the "
      "method "
      "handed over), truth (all of each pixel), frames (wrong tiles of sequences); nothing",
      0 },
    { "shard", KEY_SHARD, "I/N", 0,
      "the I-th of N parts of the cases, for one of N machines: whatever is compared stays "
      "together; `fragmark merge` joins the folders and draws the report; all",
      0 },
    { "shard-reference", KEY_SHARD_REFERENCE, "METHOD", 0,
      "its shortest case of each device and feed is measured in every shard; none; exact", 0 },
    { "no-cache", KEY_NO_CACHE, NULL, 0,
      "launches compile shaders and capture truths anew, and leave none for others; "
      "FRAGMARK_CACHE=off does so for all commands",
      0 },
    { "no-images", KEY_NO_IMAGES, NULL, 0, "keep no images", 0 },
    { "no-report", KEY_NO_REPORT, NULL, 0, "CSV files only; `fragmark report DIR` draws later", 0 },
    { "validation", KEY_VALIDATION, NULL, 0, "open devices with API validation (times suffer)", 0 },
    { "no-timers", KEY_NO_TIMERS, NULL, 0, "no timers, so that barriers follow accesses alone", 0 },
    { "quiet", 'q', NULL, 0, "no progress", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

void cli_argp_fail(struct argp_state *state, const fm_error *err)
{
    argp_error(state, "%s", err->message);
}

static void require(struct argp_state *state, fm_status status, const fm_error *err)
{
    if (status != FM_OK)
        cli_argp_fail(state, err);
}

static error_t parse_selection(int key, char *text, struct argp_state *state)
{
    fm_arguments *arguments = state->input;
    fm_error err = { 0 };
    switch (key) {
    case KEY_METHOD:
        require(state, names_add_split(&arguments->methods, text, &err), &err);
        return 0;
    case KEY_SCENE:
        require(state, names_add_split(&arguments->scenes, text, &err), &err);
        return 0;
    case KEY_DEVICE:
        require(state, names_add_split(&arguments->devices, text, &err), &err);
        return 0;
    case KEY_FEED:
        require(state, names_add_split(&arguments->feeds, text, &err), &err);
        return 0;
    case 'a':
        require(state, names_add(&arguments->axes, text, &err), &err);
        return 0;
    case KEY_PLUGINS:
        require(state, names_add(&arguments->plugin_folders, text, &err), &err);
        return 0;
    case KEY_SEED:
        arguments->has_seed = true;
        if (!text_to_u64(&arguments->seed, text) || arguments->seed > FM_KEY_UINT64_MAX)
            argp_error(state, "--seed %s: no whole number of 63 bits", text);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* "4G", "512M", "65536K", or bytes. */
static bool parse_bytes(uint64_t *bytes, const char *text)
{
    static const char units[] = "KMGT";
    char number[32];
    const size_t length = strlen(text);
    const char *unit = length > 0 ? strchr(units, text[length - 1]) : NULL;
    const unsigned shift = unit != NULL ? 10u * (unsigned)(unit - units + 1) : 0;
    if (length == 0 || length >= sizeof number)
        return false;
    snprintf(number, sizeof number, "%.*s", (int)(length - (unit != NULL)), text);
    if (!text_to_u64(bytes, number) || *bytes == 0 || *bytes > UINT64_MAX >> shift)
        return false;
    *bytes <<= shift;
    return true;
}

/* What an earlier run found out may be measured anew, but for what is well. */
static fm_status add_retried(uint32_t *retried, const char *name, fm_error *err)
{
    const char *names[FM_CASE_STATUS_COUNT];
    size_t count = 0;
    fm_case_status status;
    if (case_status_parse(&status, name) && status > FM_CASE_OK) {
        *retried |= 1u << status;
        return FM_OK;
    }
    if (case_status_parse(&status, name))
        return fm_fail(err, FM_INVALID, "--retry %s: %s", name,
                       status == FM_CASE_OK ? "what is well stays; for new times name another -o"
                                            : "the same command measures these without it");
    for (int i = FM_CASE_OK + 1; i < FM_CASE_STATUS_COUNT; i++)
        names[count++] = case_status_name((fm_case_status)i);
    const char *nearest = text_nearest(name, names, count);
    return fm_fail(err, FM_INVALID, "--retry: no status '%s'; %s '%s'", name,
                   nearest != NULL ? "the nearest is" : "there is",
                   nearest != NULL ? nearest : names[count - 1]);
}

static fm_status add_kept(uint32_t *kept, const char *name, fm_error *err)
{
    for (int i = 0; i < KEPT_KIND_COUNT; i++) {
        if (strcmp(name, kept_names[i]) == 0) {
            *kept |= 1u << i;
            return FM_OK;
        }
    }
    const char *nearest = text_nearest(name, kept_names, KEPT_KIND_COUNT);
    return fm_fail(err, FM_INVALID, "--keep: '%s' cannot be kept; %s '%s'", name,
                   nearest != NULL ? "the nearest is" : "there is",
                   nearest != NULL ? nearest : kept_names[0]);
}

/* A list of words, each of which sets a bit. */
static fm_status add_bits(uint32_t *bits, const char *text,
                          fm_status (*add)(uint32_t *bits, const char *name, fm_error *err),
                          fm_error *err)
{
    fm_text_list names = { 0 };
    fm_status status = names_add_split(&names, text, err);
    for (size_t i = 0; i < names.count && status == FM_OK; i++)
        status = add(bits, names.items[i], err);
    text_list_free(&names);
    return status;
}

static error_t parse_running(int key, char *text, struct argp_state *state)
{
    fm_arguments *arguments = state->input;
    uint64_t number = 0;
    fm_error err = { 0 };
    switch (key) {
    case KEY_RETRY:
        require(state, add_bits(&arguments->retried, text, add_retried, &err), &err);
        return 0;
    case KEY_KEEP:
        require(state, add_bits(&arguments->kept, text, add_kept, &err), &err);
        return 0;
    case 'o':
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "-o: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        arguments->directory = text;
        return 0;
    case KEY_SHARD:
        require(state, shard_parse(&arguments->shard, text, &err), &err);
        arguments->no_report = true; /* of the whole there is one, when it is merged */
        return 0;
    case KEY_SHARD_REFERENCE:
        arguments->shard.reference = text;
        return 0;
    case KEY_TIMEOUT:
        if (!text_to_u64(&number, text) || number == 0 || number > 1000000)
            argp_error(state, "--timeout %s: 1..1000000 seconds, please", text);
        arguments->timeout_s = (uint32_t)number;
        return 0;
    case KEY_MEMORY:
        if (!parse_bytes(&arguments->memory_bytes, text))
            argp_error(state, "--memory-limit %s: bytes as in 4G, 512M, please", text);
        return 0;
    case KEY_NO_IMAGES:
        arguments->no_images = true;
        return 0;
    case KEY_NO_CACHE:
        arguments->no_cache = true;
        return 0;
    case KEY_FRESH:
        arguments->fresh = true;
        return 0;
    case KEY_NO_REPORT:
        arguments->no_report = true;
        return 0;
    case KEY_VALIDATION:
        arguments->validation = true;
        return 0;
    case KEY_NO_TIMERS:
        arguments->no_timers = true;
        return 0;
    case 'q':
        arguments->quiet = true;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (arguments->shard.reference != NULL && arguments->shard.count == 0)
            argp_error(state, "--shard-reference: of which --shard I/N?");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp cli_selection_argp = { .options = selection_options, .parser = parse_selection };
const struct argp cli_running_argp = { .options = running_options, .parser = parse_running };
const struct argp_child cli_spec_children[] = {
    { &cli_selection_argp, 0, "What is measured:", 1 },
    { &cli_running_argp, 0, "How it is run:", 2 },
    { 0 },
};

error_t cli_parse_spec(int key, char *text, struct argp_state *state)
{
    fm_arguments *arguments = state->input;
    fm_error err = { 0 };
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = state->input;
        state->child_inputs[1] = state->input;
        return 0;
    case ARGP_KEY_ARG:
        if (!arguments->takes_figures && arguments->positional.count > 0)
            argp_error(state, "'%s': one SPEC.yml only", text);
        require(state, names_add(&arguments->positional, text, &err), &err);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* argp breaks lines of 79 columns without an indent: done here, under the column of texts, at
 * blanks and between the values of a list. */
static void add_wrapped(fm_text *all, const char *text)
{
    enum { WIDTH = 78, INDENT = 24 };
    while (*text != '\0') {
        size_t length = strcspn(text, "\n"), cut = length;
        if (length > WIDTH)
            for (cut = WIDTH; cut > INDENT && text[cut] != ' ' && text[cut - 1] != '|'; cut--)
                ;
        const bool is_cut = cut < length && cut > INDENT;
        cut = is_cut ? cut : length;
        text_add(all, "%.*s\n", (int)cut, text);
        if (is_cut)
            text_add(all, "%*s", INDENT, "");
        text += cut + (text[cut] == ' ' || text[cut] == '\n');
    }
}

char *cli_axes_help(int key, const char *text, void *input)
{
    (void)input;
    fm_text all = { 0 };
    if (key != ARGP_KEY_HELP_POST_DOC || text == NULL)
        return (char *)(uintptr_t)text; /* argp's own, given back as it came */
    fm_text keys = { 0 };
    text_add(&all, "%s\n\n", text);
    keys_help(&keys);
    add_wrapped(&all, keys.bytes != NULL ? keys.bytes : "");
    text_add(&all, "\n%s", CLI_EXIT_CODES);
    text_free(&keys);
    return all.bytes;
}

void arguments_free(fm_arguments *arguments)
{
    fm_text_list *const lists[] = { &arguments->positional,    &arguments->methods,
                                    &arguments->scenes,        &arguments->devices,
                                    &arguments->feeds,         &arguments->axes,
                                    &arguments->plugin_folders };
    for (size_t i = 0; i < sizeof lists / sizeof lists[0]; i++)
        text_list_free(lists[i]);
}

fm_status arguments_expand(fm_plan *plan, const fm_plugin_list *plugins,
                           const fm_arguments *arguments, const char *spec, fm_error *err)
{
    const fm_plan_request request = {
        .known_devices = arguments->cli->devices,
        .spec = spec,
        .methods = text_list_items(&arguments->methods),
        .scenes = text_list_items(&arguments->scenes),
        .devices = text_list_items(&arguments->devices),
        .feeds = text_list_items(&arguments->feeds),
        .axes = text_list_items(&arguments->axes),
        .ask = device_look,
    };
    return plan_expand(plan, &request, plugins, err);
}

fm_status cli_find_plugins(fm_plugin_list *plugins, const fm_text_list *folders, fm_error *err)
{
    const fm_status status = plugin_list_open(plugins, text_list_items(folders), err);
    plugins->reader = describe_plugins;
    return status;
}

static bool plan_has(const fm_plan *plan, const char *method)
{
    for (size_t i = 0; i < plan->count; i++)
        if (strcmp(plan->cases[i].method, method) == 0)
            return true;
    return false;
}

void cli_tell_left_out(FILE *talk, const fm_plan *plan, const fm_plugin_list *plugins)
{
    for (size_t i = 0; i < plugins->count; i++)
        if (plugin_entry_is_refused(&plugins->entries[i]) &&
            !plan_has(plan, plugins->entries[i].id))
            fprintf(talk, "left out: method '%s' is refused: %s\n", plugins->entries[i].id,
                    plugins->entries[i].error.message);
}

fm_status arguments_shard(fm_plan *plan, const fm_arguments *arguments, fm_error *err)
{
    return arguments->shard.count > 0 ? plan_shard(plan, &arguments->shard, err) : FM_OK;
}

fm_status arguments_plan(fm_plan *plan, fm_plugin_list *plugins, const fm_arguments *arguments,
                         const char *const *specs, fm_error *err)
{
    *plan = (fm_plan){ 0 };
    fm_status status = cli_find_plugins(plugins, &arguments->plugin_folders, err);
    for (size_t i = 0; status == FM_OK && (i == 0 || specs[i] != NULL); i++) {
        fm_plan one = { 0 };
        status = arguments_expand(&one, plugins, arguments, specs[i], err);
        if (status == FM_OK)
            status = plan_merge(plan, &one, err);
        plan_free(&one);
        if (specs[i] == NULL)
            break;
    }
    if (arguments->has_seed)
        plan->seed = arguments->seed;
    if (status == FM_OK)
        cli_tell_left_out(arguments->cli->talk, plan, plugins);
    return status == FM_OK ? arguments_shard(plan, arguments, err) : status;
}
