#include "merge/merge.h"

#include <stdlib.h>
#include <string.h>

#include "share.h"

enum { KEY_NO_REPORT = 512, KEY_REFERENCE };

typedef struct merge_arguments {
    fm_text_list folders;
    const char *directory, *reference;
    bool no_report;
} merge_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    merge_arguments *given = state->input;
    fm_error err = { 0 };
    switch (key) {
    case 'o':
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "-o: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->directory = text;
        return 0;
    case KEY_NO_REPORT:
        given->no_report = true;
        return 0;
    case KEY_REFERENCE:
        given->reference = text;
        return 0;
    case ARGP_KEY_ARG:
        if (names_add(&given->folders, text, &err) != FM_OK)
            cli_argp_fail(state, &err);
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (given->folders.count == 0)
            argp_error(state, "which folders? Those that `fragmark run --shard I/N -o DIR` filled");
        if (given->directory == NULL)
            argp_error(state, "where to? -o DIR, please");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "output", 'o', "DIR", 0, "folder of the merged results; an earlier merge there is replaced",
      0 },
    { "no-report", KEY_NO_REPORT, NULL, 0, "files only; `fragmark report DIR` draws later", 0 },
    { "reference", KEY_REFERENCE, "NAME|DIR|none", 0,
      "another machine's results beside ours in all charts; h100 in ratios and verdicts", 0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DIR...",
    .doc =
        "Joins the folders that `fragmark run --shard I/N` filled, and draws their report."
        "\v"
        "The cases are those of the whole plan, in its order, with the ids that they have without "
        "--shard. Times of two shards are never pooled: each row and its samples are of one shard, "
        "which shards.csv and column run_id of samples.csv name, and what is compared was measured "
        "in one shard. Cases that several shards have (--shard-reference) must agree in all that "
        "the same code gives; their times in each shard stand in shards.csv.\n"
        "\n"
        "All shards must be of one plan, one program, and the same plugins and GLSL. A shard that "
        "is missing or not finished is named, and the others are merged all the same: merge again "
        "with the same -o when it is there.\n"
        "\n"
        "Examples:\n"
        "  fragmark run my.yml --shard 1/2 -o shards/1     on one machine\n"
        "  fragmark run my.yml --shard 2/2 -o shards/2     on another\n"
        "  fragmark merge shards/* -o all\n"
        "\n"
        "Exit codes: 0 merged; 1 a claim that its figure declares required fails; 2 wrong use: a "
        "folder that is not there, or no shard, a shard twice, shards of two plans, or -o holds "
        "something else; 3 no case was measured; 4 some cases failed; 5 incomplete: shards are "
        "missing or not finished, or the report lacks something, or a file cannot be written; 7 "
        "other program, plugin or GLSL, or a case that differs where it must not; 8 a damaged or "
        "foreign folder.",
};

static int fail(const fm_cli *cli, const fm_merge_result *result, const fm_error *err)
{
    fprintf(cli->talk, "fragmark: %s\n", err->message);
    if (result->is_damaged)
        return CLI_DAMAGED;
    switch (err->status) {
    case FM_INVALID:
        return CLI_USAGE;
    case FM_UNSUPPORTED:
        return CLI_OTHER_CODE;
    default:
        return CLI_INCOMPLETE;
    }
}

/* As a run of the whole plan would end. */
static int code_of(const fm_merge_result *result)
{
    if (result->missing.count > 0)
        return CLI_INCOMPLETE;
    if (result->failed > 0)
        return CLI_SOME_FAILED;
    return result->ok > 0 || result->case_count == 0 ? CLI_DONE : CLI_NOTHING;
}

static int tell(const fm_cli *cli, const merge_arguments *given, const fm_merge_result *result)
{
    for (size_t i = 0; i < result->missing.count; i++)
        fprintf(cli->talk, "%s\n", result->missing.items[i]);
    fprintf(cli->talk,
            "%s/summary.csv: %u of %u shards, %u of %zu cases: %u ok, %u not supported, %u "
            "failed\n",
            given->directory, result->given, result->shard_count,
            result->ok + result->not_supported + result->failed, result->case_count, result->ok,
            result->not_supported, result->failed);
    cli_reasons(cli->talk, given->directory);
    const int code = code_of(result);
    char program[FM_PATH_MAX_BYTES];
    if (!given->no_report && !report_find(program))
        fprintf(cli->talk, "%s: `fragmark report %s` draws the report where it is\n",
                report_missing(), given->directory);
    const int reported =
        given->no_report ? CLI_DONE : cli_draw_report(cli, given->directory, given->reference);
    return code == CLI_INCOMPLETE || reported == CLI_DONE ? code : reported;
}

int share_merge(const fm_cli *cli, int argc, char **argv)
{
    merge_arguments given = { 0 };
    fm_merge_result result = { 0 };
    fm_error err = { 0 };
    char *command = cli_command_text(argc, argv);
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const fm_merge_desc desc = { .folders = text_list_items(&given.folders),
                                 .directory = given.directory,
                                 .command = command != NULL ? command : "" };
    const fm_status status = merge_shards(&result, &desc, &err);
    const int code = status == FM_OK ? tell(cli, &given, &result) : fail(cli, &result, &err);
    text_list_free(&result.missing);
    text_list_free(&given.folders);
    free(command);
    return code;
}
