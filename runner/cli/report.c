#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli.h"

extern char **environ;

fm_status program_folder(char folder[FM_PATH_MAX_BYTES], fm_error *err)
{
    const ssize_t length = readlink("/proc/self/exe", folder, FM_PATH_MAX_BYTES - 1);
    if (length <= 0 || length == FM_PATH_MAX_BYTES - 1)
        return fm_fail(err, FM_IO, "/proc/self/exe cannot be read");
    folder[length] = '\0';
    *strrchr(folder, '/') = '\0';
    return FM_OK;
}

static bool is_program(char path[FM_PATH_MAX_BYTES], const char *folder, size_t folder_length)
{
    const int length =
        snprintf(path, FM_PATH_MAX_BYTES, "%.*s/fragmark-report", (int)folder_length, folder);
    struct stat info;
    return length > 0 && length < FM_PATH_MAX_BYTES && access(path, X_OK) == 0 &&
           stat(path, &info) == 0 && S_ISREG(info.st_mode);
}

bool report_find(char path[FM_PATH_MAX_BYTES])
{
    char folder[FM_PATH_MAX_BYTES];
    const char *search = getenv("PATH");
    if (program_folder(folder, NULL) == FM_OK) {
        if (is_program(path, folder, strlen(folder)))
            return true;
        /* The build tree keeps each room's program in the room. */
        strncat(folder, "/reports", sizeof folder - strlen(folder) - 1);
        if (is_program(path, folder, strlen(folder)))
            return true;
    }
    while (search != NULL && *search != '\0') {
        const size_t length = strcspn(search, ":");
        if (length > 0 && is_program(path, search, length))
            return true;
        search += length + (search[length] == ':');
    }
    return false;
}

int report_execute(const char *program, const char *directory, const char *reference)
{
    pid_t pid;
    int status = 0;
    char *const argv[] = { strdup(program), strdup(directory),
                           reference != NULL ? strdup("--reference") : NULL,
                           reference != NULL ? strdup(reference) : NULL, NULL };
    const bool has_all = argv[0] != NULL && argv[1] != NULL &&
                         (reference == NULL || (argv[2] != NULL && argv[3] != NULL));
    const bool is_started = has_all && posix_spawn(&pid, program, NULL, NULL, argv, environ) == 0;
    while (is_started && waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    for (size_t i = 0; i < sizeof argv / sizeof argv[0]; i++)
        free(argv[i]);
    if (!is_started)
        return -1;
    return WIFEXITED(status) ? WEXITSTATUS(status) : CLI_SIGNAL + WTERMSIG(status);
}

typedef struct report_arguments {
    const char *directory, *reference;
} report_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    report_arguments *given = state->input;
    switch (key) {
    case 'r':
        given->reference = text;
        return 0;
    case ARGP_KEY_ARG:
        if (given->directory != NULL)
            argp_error(state, "'%s': one DIR only", text);
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
    { "reference", 'r', "NAME|DIR|none", 0,
      "another machine's results beside ours in all charts; without it h100 in ratios and verdicts",
      0 },
    CLI_HELP_OPTION,
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "DIR",
    .doc = "Draws charts and report.html again from the CSV files in DIR."
           "\v"
           "Example:\n"
           "  fragmark report first && xdg-open first/report.html\n"
           "\n" CLI_EXIT_CODES,
};

int cli_report(const fm_cli *cli, int argc, char **argv)
{
    char program[FM_PATH_MAX_BYTES];
    report_arguments given = { 0 };
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    if (!report_find(program)) {
        fprintf(cli->talk, "fragmark: fragmark-report is neither beside this program nor in PATH; "
                           "it is built where libvtk9-dev, libopenimageio-dev and librsvg2-dev "
                           "are installed\n");
        return CLI_NOTHING;
    }
    const int code = report_execute(program, given.directory, given.reference);
    if (code < 0)
        fprintf(cli->talk, "fragmark: %s cannot be executed\n", program);
    return code < 0 ? CLI_NOTHING : code;
}
