/* `fragmark gate BASE NEW` */
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands.h"
#include "comparing.h"

typedef struct gate_arguments {
    comparing_arguments shared;
    char *sides[AB_SIDE_COUNT]; /* folders */
    int side_count;
} gate_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    gate_arguments *given = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &given->shared;
        state->child_inputs[1] = &given->shared.selection;
        state->child_inputs[2] = &given->shared.selection;
        return 0;
    case ARGP_KEY_ARG:
        if (given->side_count == AB_SIDE_COUNT)
            argp_error(state, "two folders; '%s' is a third one", text);
        given->sides[given->side_count++] = text;
        return 0;
    case ARGP_KEY_END:
        if (given->side_count < AB_SIDE_COUNT)
            argp_error(state, "which folders? BASE and NEW: plugins, builds, or results");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    { &comparing_argp, 0, "How builds are judged:", 1 },
    { &cli_selection_argp, 0,
      "What is measured of builds (without scene, axis and spec: n=32, k=8, 320 x 180):", 2 },
    { &cli_running_argp, 0, "How it is run:", 3 },
    { 0 },
};

static const struct argp argp = {
    .parser = parse,
    .args_doc = "BASE NEW",
    .doc =
        "Is anything worse than before? Ends with exit code 1 if so. Of two folders of plugins, or "
        "two builds, it measures all methods that both have as `fragmark ab` does, each build by "
        "its own program if it has one: pairs of launches, `worse` only if fresh launches confirm "
        "it, outputs (status, bytes, fragments, "
        "errors) exactly and first; a case with worse outputs is not timed. Of two folders of "
        "results it judges the outputs alone, since times of two runs decide nothing; "
        "`fragmark compare` shows them. Of these, --csv has a row a case, and --json the same: "
        "verdict, what changed, code."
        "\v"
        "Examples:\n"
        "  fragmark gate /build/main /build/mine -o tonight\n"
        "  fragmark gate /build/main /build/mine --method kb,kplus-heap -a k=4,16 -a n=32\n"
        "  fragmark gate v1/methods v2/methods --pairs 10,20 --json\n"
        "  fragmark gate monday tuesday --csv gate.csv   (two of `fragmark run -o`)\n"
        "\n" COMPARING_EXIT_CODES "\n"
        "\n"
        "Axes, with their values and (default):",
    .children = children,
    .help_filter = cli_axes_help,
};

static bool is_results(const char *folder)
{
    char path[FM_PATH_MAX_BYTES];
    return path_join(path, folder, "summary.csv", NULL) == FM_OK && access(path, F_OK) == 0;
}

/* All methods of both folders; those of one alone are told. */
static fm_status choose_methods(comparing *of, FILE *talk, fm_error *err)
{
    fm_text_list all[AB_SIDE_COUNT] = { { 0 } };
    fm_status status = FM_OK;
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++)
        status = side_methods(&all[side], &of->plugins[side], of->builds[side].methods, err);
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++)
        for (size_t i = 0; i < all[side].count && status == FM_OK; i++) {
            const char *id = all[side].items[i];
            if (text_list_has(&all[1 - side], id))
                status = names_add(&of->methods[side], id, err);
            else
                fprintf(talk, "left out: method '%s' is in %s alone\n", id, ab_side_names[side]);
        }
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        text_list_free(&all[side]);
    return status == FM_OK && of->methods[AB_BASE].count == 0
               ? fm_fail(err, FM_INVALID, "%s and %s have no method in common",
                         of->builds[AB_BASE].methods, of->builds[AB_NEW].methods)
               : status;
}

static fm_status take_methods(comparing *of, FILE *talk, fm_error *err)
{
    const fm_text_list *given = &of->given->selection.methods;
    if (given->count == 0)
        return choose_methods(of, talk, err);
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        if (!text_list_add_all(&of->methods[side], given))
            return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    return FM_OK;
}

static fm_status open_both(comparing *of, gate_arguments *given, FILE *talk, fm_error *err)
{
    fm_status status = comparing_use_defaults(&given->shared, err);
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++)
        status = comparing_open(of, (ab_side_name)side, given->sides[side], err);
    if (status == FM_OK)
        status = take_methods(of, talk, err);
    if (status == FM_OK)
        status = comparing_plan(of, err);
    of->policy.stops_at_outputs = true;
    return status == FM_OK ? comparing_read_noise(of, err) : status;
}

static int gate_builds(const fm_cli *cli, gate_arguments *given, const char *command)
{
    comparing of = { .given = &given->shared };
    fm_error err = { 0 };
    int code;
    cli_directory(of.directory, &given->shared.selection);
    fm_status status = open_both(&of, given, cli->talk, &err);
    if (status != FM_OK) {
        code = comparing_refuse(&of, &err);
    } else {
        status = comparing_run(&of, command, &err);
        code = comparing_report(&of, status, &err);
    }
    comparing_free(&of);
    return code;
}

/* What says how builds are measured says nothing of results. */
static fm_status expect_no_measuring(const gate_arguments *given, fm_error *err)
{
    const fm_arguments *selection = &given->shared.selection;
    const struct {
        const char *option;
        bool is_given;
    } options[] = {
        { "--pairs", given->shared.looks[0] != 0 },
        { "--band", given->shared.band > 0.0 },
        { "--calibration", given->shared.calibration != NULL },
        { "--spec", given->shared.spec != NULL },
        { "--method", selection->methods.count > 0 },
        { "--scene", selection->scenes.count > 0 },
        { "--device", selection->devices.count > 0 },
        { "--feed", selection->feeds.count > 0 },
        { "-a", selection->axes.count > 0 },
        { "--plugin-dir", selection->plugin_folders.count > 0 },
        { "-o", selection->directory != NULL },
    };
    for (size_t i = 0; i < sizeof options / sizeof options[0]; i++)
        if (options[i].is_given)
            return fm_fail(err, FM_INVALID,
                           "%s: BASE and NEW are folders of results, of which nothing is measured",
                           options[i].option);
    return FM_OK;
}

static int gate_results(const fm_cli *cli, const gate_arguments *given)
{
    char name[] = "gate", csv[] = "--csv", json[] = "--json";
    char *argv[8] = { name, given->sides[AB_BASE], given->sides[AB_NEW] };
    int argc = 3;
    fm_error err = { 0 };
    if (expect_no_measuring(given, &err) != FM_OK)
        return cli_fail(cli, &err);
    if (given->shared.csv != NULL) {
        argv[argc++] = csv;
        argv[argc++] = given->shared.csv;
    }
    if (given->shared.selection.json)
        argv[argc++] = json;
    return report_pass_on(cli, name, argc, argv);
}

int regress_gate(const fm_cli *cli, int argc, char **argv)
{
    gate_arguments given = { .shared.selection.cli = cli };
    char *command = cli_command_text(argc, argv);
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const int code = is_results(given.sides[AB_BASE]) && is_results(given.sides[AB_NEW])
                         ? gate_results(cli, &given)
                         : gate_builds(cli, &given, command);
    comparing_arguments_free(&given.shared);
    free(command);
    return code;
}
