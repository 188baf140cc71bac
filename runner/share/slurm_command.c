#include <errno.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "share.h"
#include "slurm_jobs.h"

enum { KEY_SUBMIT = 512, KEY_SBATCH, KEY_SHARD_SBATCH, KEY_LEAD, KEY_REQUEUES };
enum { LEAD_S = 60, LEAD_MAX_S = 65535, REQUEUES_MAX = 1000 };

typedef struct slurm_arguments {
    const char *directory;
    fm_text_list words, options, shard_options;
    uint32_t shards, lead_s, requeues;
    bool submit, no_report;
} slurm_arguments;

static const struct argp_option options[] = {
    { "shards", 'n', "N", 0, "tasks of the array, a shard each; needed", 0 },
    { "output", 'o', "DIR", 0,
      "gets the scripts, logs/, shard-I/ and merged/; the same one goes on; out-UTC", 0 },
    { "submit", KEY_SUBMIT, NULL, 0, "submit both jobs; else the commands are printed", 0 },
    { "sbatch", KEY_SBATCH, "OPTION", 0,
      "of sbatch, for both jobs: --sbatch=--partition=short; repeatable", 0 },
    { "shard-sbatch", KEY_SHARD_SBATCH, "OPTION", 0,
      "the same for the shards alone: --shard-sbatch=--gres=gpu:1; repeatable", 0 },
    { "signal-lead", KEY_LEAD, "S", 0, "seconds before the time limit that a shard is stopped; 60",
      0 },
    { "requeues", KEY_REQUEUES, "N", 0,
      "how often a shard that its time limit stopped goes into the queue again by itself; 0", 0 },
    CLI_HELP_OPTION,
    { 0 },
};

static uint32_t number_of(struct argp_state *state, const char *name, const char *text,
                          uint64_t least, uint64_t most)
{
    uint64_t number = 0;
    if (!text_to_u64(&number, text) || number < least || number > most)
        argp_error(state, "%s %s: %llu..%llu, please", name, text, (unsigned long long)least,
                   (unsigned long long)most);
    return (uint32_t)number;
}

/* A line of the script. */
static void add_option(struct argp_state *state, fm_text_list *list, const char *text)
{
    fm_error err = { 0 };
    if (text[0] != '-' || strpbrk(text, "\n\r") != NULL)
        argp_error(state, "--sbatch '%s': one option of sbatch, which begins with '-'", text);
    if (names_add(list, text, &err) != FM_OK)
        cli_argp_fail(state, &err);
}

static error_t parse(int key, char *text, struct argp_state *state)
{
    slurm_arguments *given = state->input;
    switch (key) {
    case 'n':
        given->shards = number_of(state, "-n", text, 1, FM_SHARDS_MAX);
        return 0;
    case 'o':
        if (text[0] == '\0' || strlen(text) >= FM_PATH_MAX_BYTES / 2)
            argp_error(state, "-o: a path of 1 to %d bytes, please", FM_PATH_MAX_BYTES / 2 - 1);
        given->directory = text;
        return 0;
    case KEY_SUBMIT:
        given->submit = true;
        return 0;
    case KEY_SBATCH:
        add_option(state, &given->options, text);
        return 0;
    case KEY_SHARD_SBATCH:
        add_option(state, &given->shard_options, text);
        return 0;
    case KEY_LEAD:
        given->lead_s = number_of(state, "--signal-lead", text, 1, LEAD_MAX_S);
        return 0;
    case KEY_REQUEUES:
        given->requeues = number_of(state, "--requeues", text, 0, REQUEUES_MAX);
        return 0;
    case 'h':
        argp_state_help(state, state->out_stream, ARGP_HELP_STD_HELP);
        return 0;
    case ARGP_KEY_END:
        if (text_list_has(&given->words, "--shard"))
            argp_error(state, "--shard: each task has its own");
        if (given->shards == 0)
            argp_error(state, "how many shards? -n N, please");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "[SPEC.yml] [OPTIONS OF run]\nreproduce FIGURE... [OPTIONS OF reproduce]",
    .doc =
        "Writes an array job that measures N shards of a run on a Slurm cluster, and a job that "
        "merges them when all have ended."
        "\v"
        "Whatever is not among the options above goes to `fragmark run`, or to `fragmark "
        "reproduce` "
        "if that is the first word. Task I executes it with --shard I/N and -o DIR/shard-I. The "
        "program, DIR and the folder that you are in must be there on all nodes.\n"
        "\n"
        "TERM comes before the time limit, so that the journal is whole. A task that is put into "
        "the queue again, by the cluster, by `scontrol requeue` or by --requeues, goes on where it "
        "was, and so does the same command. Some shards again: sbatch --array=3,7 "
        "DIR/shards.sbatch. The merge takes the shards that there are, and names those that lack "
        "(exit code 5); DIR/merged has the report where fragmark-report is.\n"
        "\n"
        "Examples:\n"
        "  fragmark slurm my.yml -n 16 -o night --shard-sbatch=--gres=gpu:1 --submit\n"
        "  fragmark slurm --method all -a n=8:64:*2 -n 8 --requeues 5\n"
        "  fragmark slurm reproduce kplus --smoke -n 4 -o kplus\n"
        "\n"
        "Exit codes: 0 written, and with --submit submitted; 2 wrong use, a spec error, or DIR "
        "holds something else; 3 no case can run, or there is no sbatch; 5 a file cannot be "
        "written, or sbatch refused.",
};

/* How many words of argv the option at `word` is, if it is one of our own; else 0. */
static int own_words(const char *word)
{
    for (const struct argp_option *option = options; option->key != 0; option++) {
        const size_t length = option->name != NULL ? strlen(option->name) : 0;
        const bool is_long = option->name != NULL && strncmp(word, "--", 2) == 0 &&
                             strncmp(word + 2, option->name, length) == 0;
        if (is_long && word[2 + length] == '=')
            return 1;
        if (is_long && word[2 + length] == '\0')
            return option->arg != NULL ? 2 : 1;
        if (option->key < 128 && word[0] == '-' && word[1] == option->key)
            return option->arg != NULL && word[2] == '\0' ? 2 : 1;
    }
    return strcmp(word, "--help") == 0 || strcmp(word, "--usage") == 0 || strcmp(word, "-?") == 0;
}

/* Whether the first word that is not ours names the shards' command. */
static bool names_command(int argc, char **argv)
{
    int i = 1;
    while (i < argc && own_words(argv[i]) > 0)
        i += own_words(argv[i]);
    return i < argc && (strcmp(argv[i], "run") == 0 || strcmp(argv[i], "reproduce") == 0);
}

/* Ours are parsed, and others kept for the shards' command, which begins with its name. */
static fm_status take_arguments(slurm_arguments *given, int argc, char **argv, fm_error *err)
{
    int count = 1;
    fm_status status = FM_OK;
    char **own = calloc((size_t)argc + 1, sizeof *own);
    if (own == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the arguments");
    own[0] = argv[0];
    if (!names_command(argc, argv))
        status = names_add(&given->words, "run", err);
    for (int i = 1; i < argc && status == FM_OK; i++) {
        int words = own_words(argv[i]);
        if (words == 0)
            status = names_add(&given->words, argv[i], err);
        given->no_report = given->no_report || strcmp(argv[i], "--no-report") == 0;
        for (i -= words > 0; words > 0 && i + 1 < argc; words--)
            own[count++] = argv[++i];
    }
    if (status == FM_OK)
        argp_parse(&argp, count, own, 0, NULL, given);
    free(own);
    return status;
}

static void tell_commands(const fm_cli *cli, const slurm_files *files)
{
    fm_text text = { 0 };
    text_add(&text, "job=$(sbatch --parsable ");
    cli_add_word(&text, files->shards);
    text_add(&text, ")\nsbatch --dependency=afterany:$job ");
    cli_add_word(&text, files->merge);
    fprintf(cli->out, "%s\n", text.failed ? "" : text.bytes);
    text_free(&text);
}

static int write_and_submit(const fm_cli *cli, const slurm_arguments *given, const slurm_desc *desc)
{
    fm_error err = { 0 };
    slurm_files files;
    const int code = slurm_check_plan(cli, desc);
    if (code != CLI_DONE)
        return code;
    const fm_status status = slurm_write_files(&files, desc, &err);
    if (status != FM_OK) {
        cli_fail(cli, &err);
        return status == FM_INVALID ? CLI_USAGE : CLI_INCOMPLETE;
    }
    if (given->submit)
        return slurm_submit(cli, &files, desc);
    tell_commands(cli, &files);
    return CLI_DONE;
}

/* Absolute, also where it is not there yet. */
static bool make_absolute(char path[FM_PATH_MAX_BYTES], const char *here, const char *name)
{
    size_t length = strlen(name);
    while (length > 1 && name[length - 1] == '/')
        length--;
    const int count = name[0] == '/'
                          ? snprintf(path, FM_PATH_MAX_BYTES, "%.*s", (int)length, name)
                          : snprintf(path, FM_PATH_MAX_BYTES, "%s/%.*s", here, (int)length, name);
    return count > 0 && count < FM_PATH_MAX_BYTES - 64;
}

int share_slurm(const fm_cli *cli, int argc, char **argv)
{
    int code = CLI_USAGE;
    slurm_arguments given = { .lead_s = LEAD_S };
    char here[FM_PATH_MAX_BYTES], program[FM_PATH_MAX_BYTES], directory[FM_PATH_MAX_BYTES];
    char absolute[FM_PATH_MAX_BYTES];
    fm_error err = { 0 };
    const fm_status status = take_arguments(&given, argc, argv, &err);
    const fm_arguments asked = { .directory = given.directory };
    cli_directory(directory, &asked);
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    program[length > 0 ? length : 0] = '\0';
    if (status != FM_OK)
        code = cli_fail(cli, &err);
    else if (length <= 0 || getcwd(here, sizeof here) == NULL ||
             !make_absolute(absolute, here, directory))
        fprintf(cli->talk, "fragmark: %s: the path cannot be told: %s\n", directory,
                strerror(errno));
    else {
        const slurm_desc desc = { .program = program,
                                  .here = here,
                                  .directory = absolute,
                                  .words = &given.words,
                                  .options = &given.options,
                                  .shard_options = &given.shard_options,
                                  .shards = given.shards,
                                  .lead_s = given.lead_s,
                                  .requeues = given.requeues,
                                  .no_report = given.no_report };
        code = write_and_submit(cli, &given, &desc);
    }
    text_list_free(&given.words);
    text_list_free(&given.options);
    text_list_free(&given.shard_options);
    return code;
}
