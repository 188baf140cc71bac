#include "comparing.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

enum { KEY_PAIRS = 600, KEY_BAND, KEY_CALIBRATION, KEY_CSV, KEY_JSON, KEY_SPEC };

static const struct argp_option options[] = {
    { "pairs", KEY_PAIRS, "N,...", 0,
      "pairs of launches at each look, planned beforehand; a case that is decided has no more; "
      "20,40",
      0 },
    { "band", KEY_BAND, "PERCENT", 0, "the least change of a time that counts; 2%", 0 },
    { "calibration", KEY_CALIBRATION, "FILE|none", 0,
      "what this machine can see (`fragmark calibrate`); this machine's own, if there is one", 0 },
    { "spec", KEY_SPEC, "SPEC.yml", 0, "scenes, devices, feeds and axes from a file", 0 },
    { "csv", KEY_CSV, "FILE", 0, "also write the table of DIR/ab.csv here", 0 },
    { "json", KEY_JSON, NULL, 0, "print JSON instead of lines", 0 },
    { 0 },
};

static void take_looks(comparing_arguments *given, const char *text, struct argp_state *state)
{
    fm_text_list parts = { 0 };
    fm_error err = { 0 };
    ab_policy policy;
    uint64_t pairs = 0;
    if (names_add_split(&parts, text, &err) != FM_OK)
        argp_error(state, "--pairs: %s", err.message);
    for (size_t i = 0; i < parts.count; i++) {
        if (i == AB_LOOKS || !text_to_u64(&pairs, parts.items[i]) || pairs > DECIDE_VALUES)
            argp_error(state, "--pairs %s: up to %d numbers of pairs, each at most %d", text,
                       AB_LOOKS, DECIDE_VALUES);
        given->looks[i] = (uint32_t)pairs;
    }
    given->looks[parts.count] = 0;
    text_list_free(&parts);
    if (ab_policy_make(&policy, given->looks, &err) != FM_OK)
        argp_error(state, "--pairs: %s", err.message);
}

/* "2" and "2%" are the same. */
static void take_band(comparing_arguments *given, const char *text, struct argp_state *state)
{
    char number[32];
    double percent = 0.0;
    const size_t length = strlen(text);
    const bool has_sign = length > 0 && text[length - 1] == '%';
    snprintf(number, sizeof number, "%.*s", (int)(length - has_sign), text);
    if (length >= sizeof number || !text_to_double(&percent, number) || percent <= 0.0 ||
        percent > 100.0)
        argp_error(state, "--band %.40s: a share in percent, above 0, at most 100", text);
    given->band = percent / 100.0;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    comparing_arguments *given = state->input;
    switch (key) {
    case KEY_PAIRS:
        take_looks(given, text, state);
        return 0;
    case KEY_BAND:
        take_band(given, text, state);
        return 0;
    case KEY_CALIBRATION:
        given->calibration = text;
        return 0;
    case KEY_SPEC:
        given->spec = text;
        return 0;
    case KEY_CSV:
        given->csv = text;
        return 0;
    case KEY_JSON:
        given->selection.json = true;
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

const struct argp comparing_argp = { .options = options, .parser = parse };

/* Whether the user chose how many frames a launch has. */
static bool has_frames(const comparing_arguments *given)
{
    static const char name[] = "frames=";
    bool has = given->spec != NULL;
    for (size_t i = 0; i < given->selection.axes.count; i++)
        has = has || strncmp(given->selection.axes.items[i], name, sizeof name - 1) == 0;
    return has;
}

/* More frames than other commands take: on busy machines the least processor time of 20 scatters a
 * quarter as much from launch to launch as that of 5, which sixteen times as many pairs would make
 * up for. */
static fm_status use_frames(comparing_arguments *given, fm_error *err)
{
    return has_frames(given) ? FM_OK : names_add(&given->selection.axes, "frames=20", err);
}

fm_status comparing_use_defaults(comparing_arguments *given, fm_error *err)
{
    static const char *const axes[] = { "n=32", "k=8", "width_px=320", "height_px=180" };
    const bool is_chosen =
        given->spec != NULL || given->selection.scenes.count > 0 || given->selection.axes.count > 0;
    fm_status status = FM_OK;
    for (size_t i = 0; i < sizeof axes / sizeof axes[0] && status == FM_OK && !is_chosen; i++)
        status = names_add(&given->selection.axes, axes[i], err);
    return status == FM_OK ? use_frames(given, err) : status;
}

/* The side's own folder before those that were given for both. */
static fm_status list_folders(fm_text_list *folders, const comparing *of, ab_side_name side,
                              fm_error *err)
{
    const fm_status status = names_add(folders, of->folders[side], err);
    if (status == FM_OK && !text_list_add_all(folders, &of->given->selection.plugin_folders))
        return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    return status;
}

fm_status comparing_find(comparing *of, ab_side_name side, fm_error *err)
{
    fm_text_list folders = { 0 };
    fm_status status = list_folders(&folders, of, side, err);
    if (status == FM_OK)
        status = cli_find_plugins(&of->plugins[side], &folders, err);
    text_list_free(&folders);
    return status;
}

static fm_status expect_methods(const comparing *of, ab_side_name side, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < of->methods[side].count && status == FM_OK; i++)
        status =
            side_expect(&of->plugins[side], of->folders[side], of->methods[side].items[i], err);
    return status;
}

static fm_status plan_side(comparing *of, ab_side_name side, fm_error *err)
{
    fm_arguments arguments = of->given->selection;
    const char *const specs[] = { of->given->spec, NULL };
    fm_status status = expect_methods(of, side, err);
    if (status != FM_OK)
        return status;
    arguments.methods = of->methods[side];
    fm_plan one = { 0 };
    status = arguments_expand(&one, &of->plugins[side], &arguments, specs[0], err);
    if (status == FM_OK)
        status = plan_merge(&of->plans[side], &one, err);
    plan_free(&one);
    if (arguments.has_seed)
        of->plans[side].seed = arguments.seed;
    return status;
}

static fm_status expect_axes(const fm_arguments *selection, fm_error *err)
{
    static const char launches[] = "launches=";
    for (size_t i = 0; i < selection->axes.count; i++)
        if (strncmp(selection->axes.items[i], launches, sizeof launches - 1) == 0)
            return fm_fail(err, FM_INVALID, "-a %s: pairs of launches are planned with --pairs",
                           selection->axes.items[i]);
    return FM_OK;
}

fm_status comparing_plan(comparing *of, fm_error *err)
{
    const comparing_arguments *given = of->given;
    fm_status status = ab_policy_make(&of->policy, given->looks[0] != 0 ? given->looks : NULL, err);
    if (given->band > 0.0)
        of->policy.band = given->band;
    if (status == FM_OK)
        status = expect_axes(&given->selection, err);
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++)
        status = plan_side(of, (ab_side_name)side, err);
    for (size_t i = 0; i < of->plans[AB_BASE].count && status == FM_OK; i++)
        status =
            device_expect(given->selection.cli->devices, of->plans[AB_BASE].cases[i].device, err);
    return status;
}

fm_status comparing_read_noise(comparing *of, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_machine machine;
    const char *given = of->given->calibration;
    if (given != NULL && strcmp(given, "none") == 0)
        return FM_OK;
    machine_describe(&machine);
    if (given == NULL)
        return noise_path(path, &machine, NULL) == FM_OK
                   ? noise_read(&of->noise, path, &machine, err)
                   : FM_OK;
    fm_status status = noise_read(&of->noise, given, &machine, err);
    if (status == FM_OK && of->noise.count == 0)
        status = fm_fail(err, FM_INVALID, "--calibration %s: no such file", given);
    return status;
}

fm_status comparing_run(comparing *of, const char *command, fm_error *err)
{
    const fm_arguments *selection = &of->given->selection;
    const ab_desc desc = {
        .directory = of->directory,
        .command = command != NULL ? command : "",
        .plans = { &of->plans[AB_BASE], &of->plans[AB_NEW] },
        .plugins = { &of->plugins[AB_BASE], &of->plugins[AB_NEW] },
        .policy = &of->policy,
        .noise = &of->noise,
        .run = { .validation = selection->validation,
                 .no_timers = selection->no_timers,
                 .no_images = selection->no_images,
                 .retried = selection->retried,
                 .kept = selection->kept,
                 .is_fresh = selection->fresh,
                 .timeout_s = selection->timeout_s,
                 .memory_bytes = selection->memory_bytes,
                 .progress = selection->quiet ? NULL : selection->cli->talk,
                 .talk = selection->cli->talk },
    };
    /* Who reads the talk may go (`| head`): that costs the talk, and not a run of hours. */
    signal(SIGPIPE, SIG_IGN);
    return ab_run(&of->result, &desc, err);
}

static int fail(const comparing *of, const fm_error *err)
{
    const int code = cli_fail(of->given->selection.cli, err);
    if (of->result.is_other_code)
        return CLI_OTHER_CODE;
    if (err->status != FM_IO && err->status != FM_NO_MEMORY)
        return code;
    return of->result.is_damaged ? CLI_DAMAGED : CLI_INCOMPLETE;
}

static fm_status print(const comparing *of, fm_error *err)
{
    fm_text text = { 0 };
    fm_status status = FM_OK;
    if (of->given->csv != NULL) {
        ab_add_csv(&text, &of->result, &of->policy);
        status = text.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", of->given->csv)
                             : text_write_file(of->given->csv, text.bytes, text.length, err);
        text_free(&text);
    }
    if (of->given->selection.json)
        return cli_print_json(of->given->selection.cli, ab_json(&of->result, &of->policy)) ==
                       CLI_DONE
                   ? status
                   : fm_fail(err, FM_IO, "the JSON cannot be written");
    ab_add_lines(&text, &of->result, &of->policy);
    fputs(text.bytes != NULL ? text.bytes : "", of->given->selection.cli->out);
    text_free(&text);
    return status;
}

/* A case that failed on either side, and no row of which says what the method can do. */
static bool has_failed(const ab_case *of)
{
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        if (of->status[side] > FM_CASE_NOT_SUPPORTED)
            return true;
    return false;
}

static int code_of(const ab_result *result)
{
    size_t failed = 0;
    if (ab_count(result, AB_WORSE) > 0)
        return CLI_WORSE;
    for (size_t i = 0; i < result->count; i++)
        failed += has_failed(&result->cases[i]);
    if (failed > 0)
        return CLI_SOME_FAILED;
    return ab_count(result, AB_UNMEASURED) < result->count ? CLI_DONE : CLI_NOTHING;
}

int comparing_report(const comparing *of, fm_status status, const fm_error *err)
{
    fm_error below = { 0 };
    FILE *talk = of->given->selection.cli->talk;
    if (status != FM_OK)
        return fail(of, err);
    if (!of->result.is_finished) {
        fprintf(talk,
                "interrupted, nothing is lost, and nothing is judged yet: the same command with "
                "-o %s continues\n",
                of->directory);
        return CLI_SIGNAL + of->result.stop_signal;
    }
    if (print(of, &below) != FM_OK) {
        cli_fail(of->given->selection.cli, &below);
        return CLI_INCOMPLETE;
    }
    fprintf(talk, "%s/ab.csv, %s/pairs.csv; `fragmark compare %s/base %s/new` shows both runs\n",
            of->directory, of->directory, of->directory, of->directory);
    return code_of(&of->result);
}

void comparing_free(comparing *of)
{
    ab_free(&of->result);
    noise_free(&of->noise);
    for (int side = 0; side < AB_SIDE_COUNT; side++) {
        plan_free(&of->plans[side]);
        plugin_list_close(&of->plugins[side]);
        text_list_free(&of->methods[side]);
    }
}
