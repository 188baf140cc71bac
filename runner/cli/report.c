#include <errno.h>
#include <spawn.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "base/data.h"
#include "cli.h"

extern char **environ;

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
    if (data_program_folder(folder, NULL) == FM_OK && is_program(path, folder, strlen(folder)))
        return true;
    while (search != NULL && *search != '\0') {
        const size_t length = strcspn(search, ":");
        if (length > 0 && is_program(path, search, length))
            return true;
        search += length + (search[length] == ':');
    }
    return false;
}

int report_command(const char *const *argv)
{
    pid_t pid;
    int status = 0;
    char *const *passed = (char *const *)(const void *)argv; /* posix_spawn changes none */
    if (posix_spawn(&pid, argv[0], NULL, NULL, passed, environ) != 0)
        return -1;
    while (waitpid(pid, &status, 0) < 0 && errno == EINTR)
        continue;
    return WIFEXITED(status) ? WEXITSTATUS(status) : CLI_SIGNAL + WTERMSIG(status);
}

int report_execute(const char *program, const char *directory, const char *reference,
                   const char *error)
{
    const char *argv[7] = { program, directory };
    int count = 2;
    if (reference != NULL) {
        argv[count++] = "--reference";
        argv[count++] = reference;
    }
    if (error != NULL) {
        argv[count++] = "--error";
        argv[count++] = error;
    }
    return report_command(argv);
}

int cli_draw_report(const fm_cli *cli, const char *directory, const char *reference)
{
    char program[FM_PATH_MAX_BYTES];
    if (!report_find(program))
        return CLI_DONE; /* report_expect has told */
    const int code = report_execute(program, directory, reference, NULL);
    if (code == CLI_DONE || code == CLI_CLAIM_FAILS)
        return code;
    if (code == CLI_INCOMPLETE)
        fprintf(cli->talk, "the report is missing or incomplete, as told above; ");
    else
        fprintf(cli->talk, "%s failed (%d); ", program, code);
    fprintf(cli->talk, "again with: fragmark report %s\n", directory);
    return CLI_INCOMPLETE;
}

/* Has the program itself try whatever it is to draw. */
static fm_status check_inputs(const char *program, const char *reference,
                              const char *const *figures, fm_error *err)
{
    size_t count = 0, used = 0;
    while (figures[count] != NULL)
        count++;
    const char **argv = calloc(2 * count + 5, sizeof *argv);
    if (argv == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu figures", count);
    argv[used++] = program;
    argv[used++] = "--check";
    for (size_t i = 0; i < count; i++) {
        argv[used++] = "--figure";
        argv[used++] = figures[i];
    }
    if (reference != NULL) {
        argv[used++] = "--reference";
        argv[used++] = reference;
    }
    const int code = report_command(argv);
    free(argv);
    return code == CLI_DONE ? FM_OK
                            : fm_fail(err, FM_INVALID,
                                      "nothing was measured: %s could not draw the report (%d); "
                                      "with --no-report it is left out",
                                      program, code);
}

/* A name of ours, a folder with results, or none. */
static fm_status check_reference(const char *reference, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    if (reference == NULL || strcmp(reference, "none") == 0)
        return FM_OK;
    const fm_status status = strchr(reference, '/') != NULL
                                 ? path_is_folder(reference, err)
                                 : data_find(path, DATA_REFERENCES, reference, "", err);
    return status == FM_OK ? FM_OK : fm_error_prefix(err, "--reference");
}

fm_status report_expect(const fm_arguments *arguments, const char *const *figures, fm_error *err)
{
    char program[FM_PATH_MAX_BYTES];
    const fm_status status = check_reference(arguments->reference, err);
    if (status != FM_OK || arguments->no_report)
        return status;
    if (report_find(program))
        return figures[0] != NULL || arguments->reference != NULL
                   ? check_inputs(program, arguments->reference, figures, err)
                   : FM_OK;
    fprintf(arguments->cli->talk,
            "%s: no charts and no report.html will be made; `fragmark report` "
            "draws them where it is\n",
            report_missing());
    return FM_OK;
}

const char *report_missing(void)
{
    return data_is_bundle()
               ? "a bundle has no fragmark-report"
               : "fragmark-report is neither beside this program nor in PATH (it needs "
                 "libvtk9-dev, libopenimageio-dev and librsvg2-dev where it is built)";
}

typedef struct report_arguments {
    const char *directory, *reference, *error;
} report_arguments;

static error_t parse(int key, char *text, struct argp_state *state)
{
    report_arguments *given = state->input;
    switch (key) {
    case 'r':
        given->reference = text;
        return 0;
    case 'e':
        given->error = text;
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
    { "error", 'e', "METRIC", 0,
      "what is held against time: total_rmse (the default), total_flip, total_ssim, flip, "
      "covered_rmse, ...",
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
        fprintf(cli->talk, "fragmark: %s\n", report_missing());
        return CLI_NOTHING;
    }
    const int code = report_execute(program, given.directory, given.reference, given.error);
    if (code < 0)
        fprintf(cli->talk, "fragmark: %s cannot be executed\n", program);
    return code < 0 ? CLI_NOTHING : code;
}

int report_pass_on(const fm_cli *cli, const char *command, int argc, char **argv)
{
    char program[FM_PATH_MAX_BYTES];
    if (!report_find(program)) {
        fprintf(cli->talk, "fragmark: %s\n", report_missing());
        return CLI_NOTHING;
    }
    const char **passed = calloc((size_t)argc + 2, sizeof *passed);
    if (passed == NULL)
        return CLI_NOTHING;
    passed[0] = program;
    passed[1] = command;
    for (int i = 1; i < argc; i++)
        passed[i + 1] = argv[i];
    const int code = report_command(passed);
    free(passed);
    if (code < 0)
        fprintf(cli->talk, "fragmark: %s cannot be executed\n", program);
    return code < 0 ? CLI_NOTHING : code;
}

int cli_error(const fm_cli *cli, int argc, char **argv)
{
    return report_pass_on(cli, "error", argc, argv);
}

int cli_compare(const fm_cli *cli, int argc, char **argv)
{
    return report_pass_on(cli, "compare", argc, argv);
}

int cli_history(const fm_cli *cli, int argc, char **argv)
{
    return report_pass_on(cli, "history", argc, argv);
}

int cli_baseline(const fm_cli *cli, int argc, char **argv)
{
    return report_pass_on(cli, "baseline", argc, argv);
}
