#include "comparing.h"

#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

#include "program/handshake.h"

enum {
    KEY_PAIRS = 600,
    KEY_BAND,
    KEY_CALIBRATION,
    KEY_CSV,
    KEY_JSON,
    KEY_SPEC,
    KEY_CASE,
    KEY_PROGRAM
};

static const struct argp_option options[] = {
    { "pairs", KEY_PAIRS, "N,...", 0,
      "pairs of launches at each look, planned beforehand; a case that is decided has no more; "
      "20,40",
      0 },
    { "band", KEY_BAND, "PERCENT", 0, "the least change of a time that counts; 2%", 0 },
    { "calibration", KEY_CALIBRATION, "FILE|none", 0,
      "what this machine can see (`fragmark calibrate`); this machine's own, if there is one", 0 },
    { "spec", KEY_SPEC, "SPEC.yml", 0, "scenes, devices, feeds and axes from a file", 0 },
    { "case", KEY_CASE, "ID,...", 0,
      "of what is chosen these cases alone, by the id that either side has; repeatable", 0 },
    { "program", KEY_PROGRAM, "own|this", 0,
      "who measures a build: its own program, if it has one, or this one, which then measures both "
      "sides; own",
      0 },
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

static void take_program(comparing_arguments *given, const char *text, struct argp_state *state)
{
    given->is_by_this_program = strcmp(text, "this") == 0;
    if (!given->is_by_this_program && strcmp(text, "own") != 0)
        argp_error(state, "--program %.40s: own or this, please", text);
}

static void take_cases(comparing_arguments *given, const char *text, struct argp_state *state)
{
    fm_error err = { 0 };
    if (names_add_split(&given->cases, text, &err) != FM_OK)
        argp_error(state, "--case: %s", err.message);
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
    case KEY_CASE:
        take_cases(given, text, state);
        return 0;
    case KEY_PROGRAM:
        take_program(given, text, state);
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
    const bool is_chosen = given->spec != NULL || given->cases.count > 0 ||
                           given->selection.scenes.count > 0 || given->selection.axes.count > 0;
    fm_status status = FM_OK;
    for (size_t i = 0; i < sizeof axes / sizeof axes[0] && status == FM_OK && !is_chosen; i++)
        status = names_add(&given->selection.axes, axes[i], err);
    return status == FM_OK ? use_frames(given, err) : status;
}

/* The side's own folder before those that were given for both. */
static fm_status list_folders(fm_text_list *folders, const comparing *of, ab_side_name side,
                              fm_error *err)
{
    const fm_status status = names_add(folders, of->builds[side].methods, err);
    if (status == FM_OK && !text_list_add_all(folders, &of->given->selection.plugin_folders))
        return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    return status;
}

/* A build's program with another one's GLSL would be neither. */
static fm_status expect_common(const comparing *of, ab_side_name side, fm_error *err)
{
    const fm_build *build = &of->builds[side];
    const size_t length = strlen(build->methods);
    const char *common = of->plugins[side].common_folder;
    return strncmp(common, build->methods, length) == 0 && common[length] == '/'
               ? FM_OK
               : fm_fail(err, FM_INVALID,
                         "%s has no common/prelude.glsl for %s; `--program this` has this program "
                         "measure both sides",
                         build->methods, build->program);
}

static fm_status find_plugins(comparing *of, ab_side_name side, fm_error *err)
{
    fm_text_list folders = { 0 };
    fm_build *build = &of->builds[side];
    fm_status status = list_folders(&folders, of, side, err);
    if (status == FM_OK)
        status = cli_find_plugins(&of->plugins[side], &folders, err);
    text_list_free(&folders);
    if (status != FM_OK || build->program[0] == '\0')
        return status;
    of->describers[side].program = build->program;
    of->plugins[side].reader_context = &of->describers[side];
    return expect_common(of, side, err);
}

fm_status comparing_open(comparing *of, ab_side_name side, const char *path, fm_error *err)
{
    fm_build *build = &of->builds[side];
    fm_status status = build_find(build, path, err);
    if (of->given->is_by_this_program)
        build->program[0] = '\0';
    if (status == FM_OK && build->program[0] != '\0')
        status = handshake_ask(&of->has_foreign_program, build, err);
    if (of->has_foreign_program)
        fm_error_prefix(err, "%s", ab_side_names[side]);
    return status == FM_OK ? find_plugins(of, side, err) : status;
}

static fm_status expect_methods(const comparing *of, ab_side_name side, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < of->methods[side].count && status == FM_OK; i++)
        status = side_expect(&of->plugins[side], of->builds[side].methods,
                             of->methods[side].items[i], err);
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
    if (status == FM_OK && given->cases.count > 0)
        status = sides_choose(&of->plans[AB_BASE], &of->plans[AB_NEW], &given->cases, err);
    for (size_t i = 0; i < of->plans[AB_BASE].count && status == FM_OK; i++)
        status =
            device_expect(given->selection.cli->devices, of->plans[AB_BASE].cases[i].device, err);
    return status;
}

fm_status comparing_read_noise(comparing *of, fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES], path[FM_PATH_MAX_BYTES];
    fm_machine machine;
    const char *given = of->given->calibration;
    if (given != NULL && strcmp(given, "none") == 0)
        return FM_OK;
    machine_describe(&machine);
    if (given == NULL && noise_folder(folder, NULL) != FM_OK)
        return FM_OK; /* nowhere to keep one */
    fm_status status = given == NULL ? noise_find(path, folder, &machine, err) : FM_OK;
    if (status == FM_OK)
        status = noise_read(&of->noise, given == NULL ? path : given, &machine, err);
    if (status == FM_OK && given != NULL && of->noise.count == 0)
        status = fm_fail(err, FM_INVALID, "--calibration %s: no such file", given);
    return status;
}

/* Zero where this program measures the side. */
static ab_program program_of(const fm_build *build)
{
    return build->program[0] == '\0'
               ? (ab_program){ .path = NULL }
               : (ab_program){ build->program, build->commit, build->compiler };
}

fm_status comparing_run(comparing *of, const char *command, fm_error *err)
{
    const fm_arguments *selection = &of->given->selection;
    char cache[FM_PATH_MAX_BYTES];
    cli_cache(cache, selection); /* one for both sides, or none */
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
                 .cache = cache,
                 .timeout_s = selection->timeout_s,
                 .memory_bytes = selection->memory_bytes,
                 .progress = selection->quiet ? NULL : selection->cli->talk,
                 .talk = selection->cli->talk },
        .programs = { program_of(&of->builds[AB_BASE]), program_of(&of->builds[AB_NEW]) },
    };
    /* Who reads the talk may go (`| head`): that costs the talk, and not a run of hours. */
    signal(SIGPIPE, SIG_IGN);
    return ab_run(&of->result, &desc, err);
}

int comparing_refuse(const comparing *of, const fm_error *err)
{
    const int code = cli_fail(of->given->selection.cli, err);
    return of->has_foreign_program ? CLI_OTHER_CODE : code;
}

int comparing_fail(const comparing *of, const fm_error *err)
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

bool comparing_has_failures(const comparing *of)
{
    for (size_t i = 0; i < of->result.count; i++)
        if (has_failed(&of->result.cases[i]))
            return true;
    return false;
}

static int code_of(const comparing *of)
{
    if (ab_count(&of->result, AB_WORSE) > 0)
        return CLI_WORSE;
    if (comparing_has_failures(of))
        return CLI_SOME_FAILED;
    return ab_count(&of->result, AB_UNMEASURED) < of->result.count ? CLI_DONE : CLI_NOTHING;
}

int comparing_report(const comparing *of, fm_status status, const fm_error *err)
{
    fm_error below = { 0 };
    FILE *talk = of->given->selection.cli->talk;
    if (status != FM_OK)
        return comparing_fail(of, err);
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
    return code_of(of);
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

void comparing_arguments_free(comparing_arguments *given)
{
    text_list_free(&given->cases);
    arguments_free(&given->selection);
}
