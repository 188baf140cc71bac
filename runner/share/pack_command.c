#include "pack/pack.h"

#include <string.h>

#include "share.h"

typedef struct pack_arguments {
    const char *directory, *output;
} pack_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    pack_arguments *given = state->input;
    switch (key) {
    case 'o':
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "-o: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->output = text;
        return 0;
    case ARGP_KEY_ARG:
        if (given->directory != NULL)
            argp_error(state, "'%s': one DIR only", text);
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "DIR: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->directory = text;
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (given->directory == NULL)
            argp_error(state, "which DIR? One that `fragmark run -o DIR` filled");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "output", 'o', "FILE", 0,
      "NAME.tar, .tar.gz, .tgz, .tar.xz or .tar.zst; another name: a folder; DIR.tar.gz", 0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DIR",
    .doc =
        "Packs a folder of results for whoever is to check or repeat them."
        "\v"
        "The pack has the results as they are, the XXH3 checksum of each file (pack.json), and a "
        "README: commands, version and commit, plugins and GLSL with checksums, scenes, machine "
        "and drivers. The id that is printed is the checksum of pack.json: whoever is told it "
        "knows that a pack is the one that is meant. It finds damage, not forgers.\n"
        "\n"
        "Examples:\n"
        "  fragmark pack first                          first.tar.gz\n"
        "  fragmark pack first -o artifact.tar.zst\n"
        "  fragmark verify artifact.tar.zst\n"
        "\n"
        "Exit codes: 0 packed; 2 wrong use: no folder of results, or the output is there; 5 a "
        "file cannot be read or written.",
};

/* DIR.tar.gz, beside it. */
static void default_output(char output[FM_PATH_MAX_BYTES], const char *directory)
{
    size_t length = strlen(directory);
    while (length > 1 && directory[length - 1] == '/')
        length--;
    snprintf(output, FM_PATH_MAX_BYTES, "%.*s.tar.gz", (int)length, directory);
}

int share_pack(const fm_cli *cli, int argc, char **argv)
{
    pack_arguments given = { 0 };
    fm_pack_result result;
    fm_error err = { 0 };
    char output[FM_PATH_MAX_BYTES];
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    default_output(output, given.directory);
    const fm_pack_desc desc = { .directory = given.directory,
                                .output = given.output != NULL ? given.output : output };
    const fm_status status = pack_make(&result, &desc, &err);
    if (status != FM_OK) {
        fprintf(cli->talk, "fragmark: %s\n", err.message);
        return status == FM_INVALID ? CLI_USAGE : CLI_INCOMPLETE;
    }
    if (result.is_unfinished)
        fprintf(cli->talk, "%s: its run has not ended; what it has so far is packed\n",
                given.directory);
    fprintf(cli->out, "%s: %zu files, %.1f MB, id %s\n", desc.output, result.files,
            (double)result.bytes / 1e6, result.id);
    return CLI_DONE;
}
