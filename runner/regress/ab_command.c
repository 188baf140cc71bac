/* `fragmark ab METHOD@DIR1 METHOD@DIR2` */
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "comparing.h"

typedef struct ab_arguments {
    comparing_arguments shared;
    const char *sides[AB_SIDE_COUNT]; /* METHOD@DIR */
    int side_count;
} ab_arguments;

static void take_side(ab_arguments *given, const char *text, struct argp_state *state)
{
    if (given->side_count == AB_SIDE_COUNT)
        argp_error(state, "two of METHOD@DIR; '%s' is a third one", text);
    given->sides[given->side_count++] = text;
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    ab_arguments *given = state->input;
    switch (key) {
    case ARGP_KEY_INIT:
        state->child_inputs[0] = &given->shared;
        state->child_inputs[1] = &given->shared.selection;
        state->child_inputs[2] = &given->shared.selection;
        return 0;
    case ARGP_KEY_ARG:
        take_side(given, text, state);
        return 0;
    case ARGP_KEY_END:
        if (given->side_count < AB_SIDE_COUNT)
            argp_error(state, "which two? METHOD@DIR of BASE and of NEW");
        if (given->shared.selection.methods.count > 0)
            argp_error(state, "--method: METHOD@DIR names the method");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_child children[] = {
    { &comparing_argp, 0, "How it is judged:", 1 },
    { &cli_selection_argp, 0,
      "What is measured (without scene, axis and spec: n=32, k=8, 320 x 180):", 2 },
    { &cli_running_argp, 0, "How it is run:", 3 },
    { 0 },
};

static const struct argp argp = {
    .parser = parse,
    .args_doc = "METHOD@DIR1 METHOD@DIR2",
    .doc =
        "Is the second one slower? Measures a method of two plugin folders, or of two builds, by "
        "pairs of launches that run one after the other, each in a process of its own, and says of "
        "each case: worse, better, same (proved) or unclear. DIR is a folder that has METHOD/, a "
        "build with methods/, or an installed prefix. A build that has its own program is measured "
        "by it, with its shaders; this program plans and judges."
        "\v"
        "Of each pair the ratio of the launches' median times counts; on software devices that of "
        "their least processor times, too (column cpu), which other programs hardly change. A "
        "launch has 20 frames, unless -a frames=N or the spec says otherwise. A case is "
        "`same` if the whole interval lies inside the band: 2 %, or what this machine can see "
        "(`fragmark calibrate`), whichever is larger. It is `worse` or `better` if the exact "
        "signed-rank test says so, with all cases of the command taken into account, at one of the "
        "looks that --pairs plans, and the estimate itself is 2 % at least. What looks worse is "
        "measured again, on launches of its own, "
        "and only what is worse again is called so. More bytes, more errors or a worse status are "
        "worse without statistics.\n"
        "\n"
        "A command that was stopped, or killed, goes on when it is given again with the same -o. "
        "Results: DIR/ab.csv (a row a case), DIR/pairs.csv (a row a pair), DIR/base and DIR/new "
        "(two runs, as `fragmark run` writes them).\n"
        "\n"
        "Examples:\n"
        "  fragmark ab kplus-heap@/build/main kplus-heap@/build/mine -o heap\n"
        "  fragmark ab kb@old/methods kb@new/methods -a k=4,16 -a n=32 --pairs 10,20,40\n"
        "  fragmark ab mine@v1 mine@v2 --scene bunny --device osmesa --json\n"
        "  fragmark ab kb@/build/main kb@/build/mine --program this   (the method, not the "
        "runner)\n"
        "\n" COMPARING_EXIT_CODES "\n"
        "\n"
        "Axes, with their values and (default):",
    .children = children,
    .help_filter = cli_axes_help,
};

static fm_status open_side(comparing *of, ab_side_name side, const char *text, fm_error *err)
{
    char method[64];
    const char *directory;
    fm_status status = side_parse(method, &directory, text, err);
    if (status == FM_OK)
        status = names_add(&of->methods[side], method, err);
    return status == FM_OK ? comparing_open(of, side, directory, err) : status;
}

static fm_status open_both(comparing *of, ab_arguments *given, fm_error *err)
{
    fm_status status = comparing_use_defaults(&given->shared, err);
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++)
        status = open_side(of, (ab_side_name)side, given->sides[side], err);
    if (status == FM_OK)
        status = comparing_plan(of, err);
    return status == FM_OK ? comparing_read_noise(of, err) : status;
}

int regress_ab(const fm_cli *cli, int argc, char **argv)
{
    ab_arguments given = { .shared.selection.cli = cli };
    comparing of = { .given = &given.shared };
    fm_error err = { 0 };
    int code;
    char *command = cli_command_text(argc, argv);
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    cli_directory(of.directory, &given.shared.selection);
    fm_status status = open_both(&of, &given, &err);
    if (status != FM_OK) {
        code = comparing_refuse(&of, &err);
    } else {
        status = comparing_run(&of, command, &err);
        code = comparing_report(&of, status, &err);
    }
    comparing_free(&of);
    comparing_arguments_free(&given.shared);
    free(command);
    return code;
}
