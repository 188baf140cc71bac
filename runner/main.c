/* The program: subcommands, the streams they talk to, exit codes. */
#include <errno.h>
#include <signal.h>
#include <string.h>

#include "base/text.h"
#include "cli/cli.h"
#include "describe/describe.h"
#include "devices.h"
#include "inspect/dump.h"
#include "nightly/nightly.h"
#include "program/handshake.h"
#include "regress/commands.h"
#include "share/share.h"
#include "worker/worker.h"

static const struct {
    const char *name, *title; /* what argp calls itself */
    fm_command *run;
    const char *help;
} commands[] = {
    { "list", "fragmark list", cli_list, "methods, scenes, devices, figures or metrics there are" },
    { "doctor", "fragmark doctor", cli_doctor,
      "what this machine can run, and how to fix what it cannot" },
    { "plan", "fragmark plan", cli_plan,
      "the cases of a run and the estimated time; runs nothing" },
    { "run", "fragmark run", cli_run, "measures methods on scenes" },
    { "reproduce", "fragmark reproduce", cli_reproduce, "measures what figures of a paper show" },
    { "merge", "fragmark merge", share_merge,
      "the folders of `run --shard` as one, with their report" },
    { "slurm", "fragmark slurm", share_slurm, "shards and their merge as jobs of a Slurm cluster" },
    { "pack", "fragmark pack", share_pack, "results with checksums and versions, to hand on" },
    { "verify", "fragmark verify", share_verify,
      "what of a pack is damaged, and what is another on this machine" },
    { "dump", "fragmark dump", inspect_dump,
      "fragments of a pixel, and what is wrong with them, from what a run kept" },
    { "record", "fragmark record", cli_record,
      "a scene for the simulated GPU from what an OpenGL program draws" },
    { "bundle", "fragmark bundle", cli_bundle,
      "a folder with all that measuring needs, for a machine without packages" },
    { "error", "fragmark error", cli_error, "how far two image files are apart" },
    { "compare", "fragmark compare", cli_compare,
      "two runs, case by case: ratios, and what changed" },
    { "nightly", "fragmark nightly", nightly_command,
      "what fits the time, measured, recorded, and held against the nights before" },
    { "baseline", "fragmark baseline", cli_baseline,
      "names a run, so that later ones are held against it" },
    { "history", "fragmark history", cli_history, "many nights: since when something is slower" },
    { "ab", "fragmark ab", regress_ab,
      "a method of two builds, by pairs of launches: is it slower?" },
    { "gate", "fragmark gate", regress_gate,
      "two builds, or two folders of results: exit code 1 if a case is worse" },
    { "calibrate", "fragmark calibrate", regress_calibrate,
      "how small a change this machine can see" },
    { "report", "fragmark report", cli_report, "charts and report.html again from the CSV" },
};
enum { COMMAND_COUNT = sizeof commands / sizeof commands[0] };

static void write_help(FILE *out)
{
    fprintf(out,
            "Usage: fragmark COMMAND [ARGUMENTS]\n"
            "Benchmarks and reproduces multi-fragment rendering methods: k-buffers, A-buffers.\n"
            "\n");
    for (int i = 0; i < COMMAND_COUNT; i++)
        fprintf(out, "  %-10s %s\n", commands[i].name, commands[i].help);
    fprintf(out, "\n`fragmark COMMAND --help` tells more, with examples. To begin with:\n"
                 "  fragmark doctor\n"
                 "  fragmark run --method all -a n=16 -a launches=2 -o first\n"
                 "\n" CLI_EXIT_CODES "\n");
}

static int unknown_command(const char *name)
{
    const char *names[COMMAND_COUNT];
    for (int i = 0; i < COMMAND_COUNT; i++)
        names[i] = commands[i].name;
    const char *nearest = text_nearest(name, names, COMMAND_COUNT);
    fprintf(stderr, "fragmark: no command '%s'; ", name);
    if (nearest != NULL)
        fprintf(stderr, "the nearest is '%s'\n", nearest);
    else
        fprintf(stderr, "`fragmark --help` lists them\n");
    return CLI_USAGE;
}

static int run_command(int index, int argc, char **argv)
{
    char title[32];
    const fm_cli cli = { .out = stdout, .talk = stderr, .devices = &program_devices };
    snprintf(title, sizeof title, "%s", commands[index].title);
    argv[0] = title;
    argp_err_exit_status = CLI_USAGE;
    const int code = commands[index].run(&cli, argc, argv);
    /* Data that did not arrive, on a full disk say, must not look like success. */
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    fprintf(stderr, "fragmark: what it printed could not be written: %s\n", strerror(errno));
    return CLI_NOTHING;
}

int main(int argc, char **argv)
{
    if (argc < 2) {
        write_help(stderr);
        return CLI_USAGE;
    }
    /* A limit on files is an error of whoever writes, which tells what it could not write. */
    signal(SIGXFSZ, SIG_IGN);
    const char *name = argv[1];
    if (strcmp(name, "worker") == 0 && argc == 4)
        return worker_main(argv[2], argv[3], &program_devices);
    if (strcmp(name, "describe") == 0 && argc >= 4)
        return describe_main(argv[2], argv + 3);
    if (strcmp(name, "protocol") == 0 && argc == 3)
        return handshake_main(argv[2]);
    if (strcmp(name, "--help") == 0 || strcmp(name, "-h") == 0 || strcmp(name, "help") == 0) {
        write_help(stdout);
        return CLI_DONE;
    }
    if (strcmp(name, "--version") == 0 || strcmp(name, "-V") == 0) {
        printf("fragmark %s\n", FM_VERSION);
        return CLI_DONE;
    }
    for (int i = 0; i < COMMAND_COUNT; i++)
        if (strcmp(name, commands[i].name) == 0)
            return run_command(i, argc - 1, argv + 1);
    return unknown_command(name);
}
