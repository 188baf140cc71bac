#include "pack/verify.h"

#include <string.h>

#include "share.h"

enum { KEY_PLUGINS = 512, KEY_JSON };

typedef struct verify_arguments {
    const char *path;
    fm_text_list plugin_folders;
    bool json;
} verify_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    verify_arguments *given = state->input;
    fm_error err = { 0 };
    switch (key) {
    case KEY_PLUGINS:
        if (names_add(&given->plugin_folders, text, &err) != FM_OK)
            cli_argp_fail(state, &err);
        return 0;
    case KEY_JSON:
        given->json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (given->path != NULL)
            argp_error(state, "'%s': one PACK only", text);
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "PACK: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->path = text;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (given->path == NULL)
            argp_error(state, "which PACK? One that `fragmark pack` made");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "plugin-dir", KEY_PLUGINS, "DIR", 0, "look for methods here first; repeatable", 0 },
    { "json", KEY_JSON, NULL, 0, "as JSON", 0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "PACK",
    .doc =
        "Says which files of a pack are damaged, missing or added, and what is another on this "
        "machine than where it was measured: version, program, plugins, GLSL, scenes, machine."
        "\v"
        "PACK is an archive that `fragmark pack` made, or its folder. Archives are unpacked in "
        "TMPDIR. What is another here is told and fails nothing: results stay what they are, and "
        "whoever repeats them knows what to expect. Drivers are compared when a device is opened, "
        "by `fragmark compare`.\n"
        "\n"
        "Examples:\n"
        "  fragmark verify artifact.tar.gz\n"
        "  fragmark verify artifact --json\n"
        "\n"
        "Exit codes: 0 each file is as it was packed; 2 wrong use, or no such file; 5 it cannot "
        "be read or unpacked here; 8 damaged: files differ, lack or were added, or it is no "
        "pack.",
};

static void write_list(const fm_cli *cli, const char *what, const fm_text_list *list)
{
    for (size_t i = 0; i < list->count; i++)
        fprintf(cli->out, "%s: %s\n", what, list->items[i]);
}

static json_t *list_json(const fm_text_list *list)
{
    json_t *json = json_array();
    for (size_t i = 0; i < list->count; i++)
        json_array_append_new(json, json_string(list->items[i]));
    return json;
}

static bool is_whole(const fm_verify_result *result)
{
    return result->damaged.count + result->missing.count + result->unlisted.count == 0;
}

static void write_result(const fm_cli *cli, const char *path, const fm_verify_result *result)
{
    write_list(cli, "damaged", &result->damaged);
    write_list(cli, "missing", &result->missing);
    write_list(cli, "added", &result->unlisted);
    write_list(cli, "another here", &result->differences);
    fprintf(cli->out, "%s: %s: %zu files, %.1f MB as they were packed, id %s\n", path,
            is_whole(result) ? "whole" : "DAMAGED", result->files, (double)result->bytes / 1e6,
            result->id);
}

static int write_json(const fm_cli *cli, const fm_verify_result *result)
{
    return cli_print_json(
        cli,
        json_pack("{s:i, s:s, s:b, s:I, s:I, s:o, s:o, s:o, s:o}", "schema", 1, "id", result->id,
                  "is_whole", (int)is_whole(result), "files", (json_int_t)result->files, "bytes",
                  (json_int_t)result->bytes, "damaged", list_json(&result->damaged), "missing",
                  list_json(&result->missing), "added", list_json(&result->unlisted), "differences",
                  list_json(&result->differences)));
}

static int tell(const fm_cli *cli, const verify_arguments *given, const fm_verify_result *result)
{
    int code = CLI_DONE;
    if (given->json)
        code = write_json(cli, result);
    else
        write_result(cli, given->path, result);
    return code == CLI_DONE && !is_whole(result) ? CLI_DAMAGED : code;
}

static int fail(const fm_cli *cli, const fm_verify_result *result, const fm_error *err)
{
    fprintf(cli->talk, "fragmark: %s\n", err->message);
    if (result->is_foreign)
        return CLI_DAMAGED;
    return err->status == FM_INVALID ? CLI_USAGE : CLI_INCOMPLETE;
}

int share_verify(const fm_cli *cli, int argc, char **argv)
{
    verify_arguments given = { 0 };
    fm_verify_result result = { 0 };
    fm_plugin_list plugins = { 0 };
    fm_error err = { 0 };
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    fm_status status = cli_find_plugins(&plugins, &given.plugin_folders, &err);
    if (status == FM_OK)
        status = verify_pack(&result, given.path, &plugins, &err);
    const int code = status == FM_OK ? tell(cli, &given, &result) : fail(cli, &result, &err);
    verify_free(&result);
    plugin_list_close(&plugins);
    text_list_free(&given.plugin_folders);
    return code;
}
