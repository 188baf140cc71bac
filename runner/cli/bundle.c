#include "bundle/bundle.h"

#include <gnu/libc-version.h>
#include <string.h>

#include "cli.h"

enum { KEY_METHODS = 512, KEY_PLUGINS };

typedef struct bundle_arguments {
    const char *directory;
    fm_text_list methods, plugin_folders;
} bundle_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    bundle_arguments *given = state->input;
    fm_error err = { 0 };
    fm_status status = FM_OK;
    switch (key) {
    case KEY_METHODS:
        status = names_add_split(&given->methods, text, &err);
        break;
    case KEY_PLUGINS:
        status = names_add(&given->plugin_folders, text, &err);
        break;
    case ARGP_KEY_ARG:
        if (given->directory != NULL)
            argp_error(state, "'%s': one DIR only", text);
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "DIR: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->directory = text;
        break;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        break;
    case ARGP_KEY_END:
        if (given->directory == NULL)
            argp_error(state, "which DIR? A new folder, please");
        break;
    default:
        return ARGP_ERR_UNKNOWN;
    }
    if (status != FM_OK)
        cli_argp_fail(state, &err);
    return 0;
}

static const struct argp_option options[] = {
    { "methods", KEY_METHODS, "A,B", 0, "these methods, and the floors of feeds; all", 0 },
    { "plugin-dir", KEY_PLUGINS, "DIR", 0, "look for methods here first; repeatable", 0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DIR",
    .doc = "Makes a folder with all that measuring needs, for a machine without root or packages."
           "\v"
           "DIR gets this program, methods, GLSL, scenes, figures, references and the shared "
           "libraries but glibc's. It runs where glibc is at least as new as here, under any path. "
           "The GPU's driver is the machine's own. fragmark-report stays here, because charts need "
           "VTK and some 200 libraries: copy the results back, and draw them with `fragmark "
           "report`. libOSMesa is left out, too.\n"
           "\n"
           "Examples:\n"
           "  fragmark bundle kit && tar czf kit.tgz kit\n"
           "  fragmark bundle small --methods kplus-array,ab-ll\n"
           "\n" CLI_EXIT_CODES,
};

int cli_bundle(const fm_cli *cli, int argc, char **argv)
{
    bundle_arguments given = { 0 };
    fm_bundle_result result;
    fm_error err = { 0 };
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const fm_bundle_desc desc = { .directory = given.directory,
                                  .plugin_folders = &given.plugin_folders,
                                  .methods = &given.methods };
    const fm_status status = bundle_make(&result, &desc, &err);
    if (status == FM_OK)
        fprintf(cli->out,
                "%s: %u methods, %u scenes, %u figures, %u files of references, %u libraries; "
                "%.1f MB; for glibc %s or newer; see its README\n",
                given.directory, result.methods, result.scenes, result.figures, result.references,
                result.libraries, (double)result.bytes / 1e6, gnu_get_libc_version());
    text_list_free(&given.methods);
    text_list_free(&given.plugin_folders);
    if (status == FM_OK)
        return CLI_DONE;
    cli_fail(cli, &err);
    return status == FM_INVALID ? CLI_USAGE : CLI_NOTHING;
}
