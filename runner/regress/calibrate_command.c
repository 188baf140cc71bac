/* `fragmark calibrate` */
#include <ftw.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "comparing.h"
#include "decide/binomial.h"

enum { KEY_PAIRS = 700, KEY_RESULTS, PAIRS = 60 };

typedef struct calibrate_arguments {
    comparing_arguments shared;
    const char *file;    /* -o; NULL: this machine's */
    const char *results; /* NULL: a folder that is removed */
    uint32_t pairs;
} calibrate_arguments;

static void take_pairs(calibrate_arguments *given, const char *text, struct argp_state *state)
{
    uint64_t pairs = 0;
    if (!text_to_u64(&pairs, text) || pairs < 20 || pairs > 500)
        argp_error(state, "--pairs %s: 20..500, please", text);
    given->pairs = (uint32_t)pairs;
}

static void expect_path(const char *path, const char *option, struct argp_state *state)
{
    if (path[0] == '\0' || strlen(path) >= FM_PATH_MAX_BYTES / 2)
        argp_error(state, "%s: a path of 1 to %d bytes, please", option, FM_PATH_MAX_BYTES / 2 - 1);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    calibrate_arguments *given = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &given->shared.selection;
        return 0;
    case KEY_PAIRS:
        take_pairs(given, text, state);
        return 0;
    case KEY_RESULTS:
        expect_path(text, "--results", state);
        given->results = text;
        return 0;
    case 'o':
        expect_path(text, "-o", state);
        given->file = text;
        return 0;
    case 'q':
        given->shared.selection.quiet = true;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "output", 'o', "FILE", 0,
      "where it is kept; $XDG_STATE_HOME/fragmark/calibration/MACHINE.json, or the same in "
      "~/.local/state: what ab and gate read",
      0 },
    { "pairs", KEY_PAIRS, "N", 0, "pairs of launches; 60", 0 },
    { "results", KEY_RESULTS, "DIR", 0,
      "keep the launches here, as `fragmark ab` does; the same folder continues", 0 },
    { "quiet", 'q', NULL, 0, "no progress", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

static const struct argp_child children[] = {
    { &cli_selection_argp, 0,
      "What is measured (without them: kplus-heap, n=32, k=8, 320 x 180):", 2 },
    { 0 },
};

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .doc =
        "How small a change can this machine see? Compares a method with itself, by pairs of "
        "launches as `fragmark ab` does, and keeps how much they differ. `ab` and `gate` take from "
        "there which changes count: the larger of 2 % and three standard errors of 20 pairs. "
        "Without "
        "a calibration they take it from the pairs that they judge."
        "\v"
        "Detectable is the smallest change that it finds, and confirms, in 94 % of "
        "500 "
        "gates whose pairs are drawn from those that were measured.\n"
        "\n"
        "`fragmark calibrate device` measures what a device can do at most (its own --help).\n"
        "\n"
        "Calibrate each device once, when the machine does what it does at night, and again when "
        "the machine has changed. Of several cases on one device the noisiest is kept: the one "
        "with "
        "the largest detectable change, of processor time on software devices, else of time. A "
        "file holds one machine: processor, cores, and memory within 2 %.\n"
        "\n"
        "Examples:\n"
        "  fragmark calibrate\n"
        "  fragmark calibrate --device osmesa --method kb --pairs 100\n"
        "  fragmark calibrate -o calibration.json && fragmark gate A B --calibration "
        "calibration.json\n"
        "\n"
        "Exit codes: 0 done; 2 usage error, or a calibration that cannot be added to, nothing was "
        "run; 3 nothing could be measured; 4 cases failed, and the others are kept; 5 "
        "incomplete: with --results the same command continues; 7 other code than the launches in "
        "--results were begun with; 8 damaged or foreign file there; 129, 130, 143 interrupted.\n"
        "\n"
        "Axes, with their values and (default):",
    .children = children,
    .help_filter = cli_axes_help,
};

/* The folder that a folder METHOD/METHOD.so lies in. */
static void take_folder(char folder[FM_PATH_MAX_BYTES], const char *path)
{
    snprintf(folder, FM_PATH_MAX_BYTES, "%s", path);
    for (int i = 0; i < 2; i++) {
        char *slash = strrchr(folder, '/');
        if (slash != NULL)
            *slash = '\0';
    }
}

/* The same method of the same folder, twice. */
static fm_status open_both(comparing *of, calibrate_arguments *given, fm_error *err)
{
    fm_plugin_list all = { 0 };
    fm_plugin_entry *entry;
    fm_arguments *selection = &given->shared.selection;
    fm_status status = comparing_use_defaults(&given->shared, err);
    if (status == FM_OK && selection->methods.count > 1)
        status = fm_fail(err, FM_INVALID, "--method: one alone");
    const char *method = selection->methods.count > 0 ? selection->methods.items[0] : "kplus-heap";
    if (status == FM_OK)
        status = cli_find_plugins(&all, &selection->plugin_folders, err);
    if (status == FM_OK)
        status = plugin_list_get(&entry, &all, method, err);
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++) {
        char folder[FM_PATH_MAX_BYTES];
        take_folder(folder, entry->path);
        status = names_add(&of->methods[side], method, err);
        if (status == FM_OK)
            status = comparing_open(of, (ab_side_name)side, folder, err);
    }
    plugin_list_close(&all);
    if (status == FM_OK)
        status = comparing_plan(of, err);
    of->policy.only_looks = true;
    return status;
}

static fm_status take_noise(ab_noise *noise, const ab_case *of, uint32_t pairs,
                            const ab_policy *policy, fm_error *err)
{
    *noise = (ab_noise){ .pairs = 0 };
    snprintf(noise->device_name, sizeof noise->device_name, "%s", of->device_name);
    snprintf(noise->measured, sizeof noise->measured, "%s", of->name);
    return noise_of_pairs(noise, of->tested.differences, pairs, policy, err);
}

static void tell(const fm_cli *cli, const ab_noise *noise, const ab_policy *policy)
{
    fprintf(cli->out, "%s: %s, %u pairs\n", noise->device_name, noise->measured, noise->pairs);
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        const ab_noise_statistic *of = &noise->statistics[s];
        fm_interval alarms = { NAN, NAN, NAN };
        if (of->detectable == 0.0)
            continue;
        binomial_interval(&alarms, of->alarms, of->gates, 0.95, NULL);
        fprintf(cli->out,
                "%-5s pairs differ by %.1f %% (standard deviation); changes count from %.1f %%; "
                "detectable are %.1f %% with %u pairs, %.1f %% with %u; false alarms before "
                "confirmation: %u of %u gates of %u pairs (%.0f to %.0f %%)\n",
                ab_statistic_names[s], 100.0 * expm1(of->deviation),
                100.0 * fmax(policy->band, expm1(AB_ERRORS_THAT_COUNT * of->standard_error)),
                100.0 * expm1(of->detectable_first), policy->looks[0],
                100.0 * expm1(of->detectable), policy->looks[policy->look_count - 1], of->alarms,
                of->gates, policy->looks[0], 100.0 * alarms.low, 100.0 * alarms.high);
    }
}

/* A case that failed, on one side at least, before it had as many pairs as a first look. */
static void tell_left_out(const fm_cli *cli, const ab_case *of, const char *why)
{
    fprintf(cli->talk, "left out, for it was not measured: %s: %s\n", of->name,
            of->message[AB_BASE][0] != '\0'  ? of->message[AB_BASE]
            : of->message[AB_NEW][0] != '\0' ? of->message[AB_NEW]
                                             : why);
}

static void tell_noisiest(const fm_cli *cli, const ab_noise_list *measured, const ab_result *of)
{
    for (size_t i = 0; i < measured->count; i++) {
        const ab_noise *noise = &measured->items[i];
        size_t cases = 0;
        for (size_t j = 0; j < of->count; j++)
            cases += of->cases[j].verdict != AB_UNMEASURED &&
                     strcmp(of->cases[j].device_name, noise->device_name) == 0;
        if (cases > 1)
            fprintf(cli->out, "%s: of these the noisiest case is kept: %s\n", noise->device_name,
                    noise->measured);
    }
}

/* Of each device the noisiest case: what a gate takes for a change is then one in every case. */
static fm_status gather(ab_noise_list *measured, const comparing *of,
                        const calibrate_arguments *given, fm_error *err)
{
    const fm_cli *cli = given->shared.selection.cli;
    ab_policy usual;
    fm_status status = ab_policy_make(&usual, NULL, err);
    for (size_t i = 0; i < of->result.count && status == FM_OK; i++) {
        ab_noise noise;
        status = take_noise(&noise, &of->result.cases[i], given->pairs, &usual, err);
        if (status == FM_INVALID) { /* too few pairs */
            tell_left_out(cli, &of->result.cases[i], err->message);
            status = FM_OK;
            continue;
        }
        if (status == FM_OK)
            status = noise_keep_noisiest(measured, &noise, err);
        if (status == FM_OK)
            tell(cli, &noise, &usual);
    }
    return status;
}

/* Reads what this machine's file holds so far. */
static fm_status read_kept(ab_noise_list *list, char path[FM_PATH_MAX_BYTES],
                           const calibrate_arguments *given, const fm_machine *machine,
                           fm_error *err)
{
    char folder[FM_PATH_MAX_BYTES];
    fm_status status = FM_OK;
    *list = (ab_noise_list){ 0 };
    if (given->file != NULL) {
        snprintf(path, FM_PATH_MAX_BYTES, "%s", given->file);
    } else {
        status = noise_folder(folder, err);
        if (status == FM_OK)
            status = noise_find(path, folder, machine, err);
    }
    return status == FM_OK ? noise_read(list, path, machine, err) : status;
}

/* Before minutes are spent: a file that cannot be added to. */
static fm_status expect_file(const calibrate_arguments *given, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_machine machine;
    ab_noise_list list;
    machine_describe(&machine);
    const fm_status status = read_kept(&list, path, given, &machine, err);
    noise_free(&list);
    return status;
}

/* Each device's calibration takes the place of its last one. */
static fm_status keep(const ab_noise_list *measured, const calibrate_arguments *given,
                      fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_machine machine;
    ab_noise_list list;
    machine_describe(&machine);
    fm_status status = read_kept(&list, path, given, &machine, err);
    for (size_t i = 0; i < measured->count && status == FM_OK; i++)
        status = noise_keep(&list, &measured->items[i], err);
    if (status == FM_OK)
        status = noise_write(path, &list, &machine, err);
    if (status == FM_OK)
        fprintf(given->shared.selection.cli->talk, "kept in %s\n", path);
    noise_free(&list);
    return status;
}

static int remove_entry(const char *path, const struct stat *info, int kind, struct FTW *level)
{
    (void)info, (void)kind, (void)level;
    return remove(path);
}

static int keep_all(const comparing *of, const calibrate_arguments *given)
{
    const fm_cli *cli = given->shared.selection.cli;
    fm_error err = { 0 };
    ab_noise_list measured = { 0 };
    int code = comparing_has_failures(of) ? CLI_SOME_FAILED : CLI_DONE;
    fm_status status = gather(&measured, of, given, &err);
    if (status == FM_OK && measured.count == 0) {
        fprintf(cli->talk, "fragmark: nothing could be measured\n");
        code = code == CLI_DONE ? CLI_NOTHING : code;
    } else if (status == FM_OK) {
        tell_noisiest(cli, &measured, &of->result);
        status = keep(&measured, given, &err);
    }
    if (status != FM_OK) {
        cli_fail(cli, &err);
        code = CLI_INCOMPLETE;
    }
    noise_free(&measured);
    return code;
}

static int finish(const comparing *of, const calibrate_arguments *given, fm_status status,
                  const fm_error *err)
{
    if (status != FM_OK)
        return comparing_fail(of, err);
    if (of->result.is_finished)
        return keep_all(of, given);
    fprintf(given->shared.selection.cli->talk, "interrupted: nothing is kept%s\n",
            given->results != NULL ? "; the same command continues" : "");
    return CLI_SIGNAL + of->result.stop_signal;
}

static int calibrate(comparing *of, calibrate_arguments *given, const char *command)
{
    fm_error err = { 0 };
    fm_status status = open_both(of, given, &err);
    if (status == FM_OK)
        status = expect_file(given, &err);
    if (status != FM_OK)
        return cli_fail(given->shared.selection.cli, &err);
    if (given->results != NULL)
        snprintf(of->directory, sizeof of->directory, "%s", given->results);
    else
        status = path_make_temporary(of->directory, "fragmark-calibrate", &err);
    if (status == FM_OK)
        status = comparing_run(of, command, &err);
    const int code = finish(of, given, status, &err);
    if (given->results == NULL && of->directory[0] != '\0')
        nftw(of->directory, remove_entry, 16, FTW_DEPTH | FTW_PHYS);
    return code;
}

int regress_calibrate(const fm_cli *cli, int argc, char **argv)
{
    char device_title[] = "fragmark calibrate device";
    calibrate_arguments given = { .shared.selection = { .cli = cli, .no_images = true },
                                  .pairs = PAIRS };
    if (argc > 1 && strcmp(argv[1], "device") == 0) {
        argv[1] = device_title;
        return regress_calibrate_device(cli, argc - 1, argv + 1);
    }
    comparing of = { .given = &given.shared };
    char *command = cli_command_text(argc, argv);
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    given.shared.looks[0] = given.pairs;
    const int code = calibrate(&of, &given, command);
    comparing_free(&of);
    comparing_arguments_free(&given.shared);
    free(command);
    return code;
}
