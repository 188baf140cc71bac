/* What the subcommands share. They write data to `out` and talk to `talk`.
 *
 * The room cli holds the subcommands, their options, their help and their exit codes, one file
 * each. What they do is done below; nothing below prints or exits. */
#ifndef FM_CLI_H
#define FM_CLI_H

#include <argp.h>
#include <jansson.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "base/error.h"
#include "base/text.h"
#include "device/registry.h"
#include "model/exit_code.h"
#include "plan/shard.h"

enum {
    CLI_DONE = FM_EXIT_DONE, /* model/exit_code.h says what each means */
    CLI_CLAIM_FAILS = FM_EXIT_CLAIM_FAILS,
    CLI_WORSE = FM_EXIT_WORSE,
    CLI_USAGE = FM_EXIT_USAGE,
    CLI_NOTHING = FM_EXIT_NOTHING,
    CLI_SOME_FAILED = FM_EXIT_SOME_FAILED,
    CLI_INCOMPLETE = FM_EXIT_INCOMPLETE,
    CLI_OTHER_CODE = FM_EXIT_OTHER_CODE,
    CLI_DAMAGED = FM_EXIT_DAMAGED,
    CLI_SIGNAL = 128, /* + its number: interrupted, can be continued */
};
#define CLI_EXIT_CODES                                                                             \
    "Exit codes: 0 done; 1 a claim that its figure declares required fails, or a case is worse "   \
    "(ab, gate); 2 usage or spec error, nothing was run; 3 nothing could be measured; "            \
    "4 some cases failed (crash, timeout, out of memory, refused plugin, wrong image of an exact " \
    "method); 5 incomplete: a full disk, a missing driver, a limit or somebody's kill stopped "    \
    "the run, and the same command continues it, or the report cannot be drawn, or lacks "         \
    "something; 7 other code (program, driver, plugin or shaders) than rows were begun with, or "  \
    "runs that do not compare; "                                                                   \
    "8 damaged or foreign file; 129, 130, 143 interrupted: the same command continues it."

/* What main.c hands to every subcommand. */
typedef struct fm_cli {
    FILE *out, *talk;
    const fm_device_list *devices; /* those of the program */
} fm_cli;

/* One subcommand; argv[0] is "fragmark NAME". Returns the exit code. */
typedef int fm_command(const fm_cli *cli, int argc, char **argv);
fm_command cli_list, cli_doctor, cli_plan, cli_run, cli_reproduce, cli_record, cli_report,
    cli_bundle, cli_error, cli_compare, cli_history, cli_baseline;

/* Says what went wrong before anything was run, and returns the exit code for it: CLI_USAGE where
 * the arguments, or files that they name, are to blame. */
int cli_fail(const fm_cli *cli, const fm_error *err);
/* Prints JSON and drops it. */
int cli_print_json(const fm_cli *cli, json_t *object);

/* Adds a name. FM_NO_MEMORY. */
fm_status names_add(fm_text_list *names, const char *name, fm_error *err);
/* Adds each part between commas; empty parts are FM_INVALID. */
fm_status names_add_split(fm_text_list *names, const char *list, fm_error *err);

/* What run, plan and reproduce take. */
typedef struct fm_arguments {
    const fm_cli *cli;
    bool takes_figures;
    fm_text_list positional; /* one spec; figures where it takes them */
    fm_text_list methods, scenes, devices, feeds, axes, plugin_folders;
    const char *directory; /* -o; NULL: not given */
    const char *reference; /* for the report: NAME, DIR or none; NULL: not given */
    uint32_t timeout_s;
    uint64_t memory_bytes, seed;
    fm_shard_desc shard; /* count 0: the whole plan */
    uint32_t retried;    /* statuses, as bits */
    uint32_t kept;       /* kept_kind, as bits */
    bool has_seed, no_images, no_cache, no_report, validation, no_timers, quiet, json;
    bool smoke, large, fresh;
} fm_arguments;

/* Options that these subcommands have in common; children of their argp. */
extern const struct argp cli_selection_argp; /* --method ... -a, --plugin-dir, --seed */
extern const struct argp cli_running_argp;   /* -o, --timeout ... */
/* The parser of these subcommands, but for their own options: hands on to both and keeps what is
 * positional. */
error_t cli_parse_spec(int key, char *text, struct argp_state *state);
/* Both, as run and plan show them; ends with {0}. */
extern const struct argp_child cli_spec_children[];
/* For argp's help_filter: "\v"-less text that ends with the table of axes. */
char *cli_axes_help(int key, const char *text, void *input);
/* -h is --help: argp itself knows -? only. */
#define CLI_HELP_OPTION                                                                            \
    {                                                                                              \
        NULL, 'h', NULL, OPTION_HIDDEN, NULL, 0                                                    \
    }
/* argp_failure with err's message: prints it and ends the program with CLI_USAGE. */
void cli_argp_fail(struct argp_state *state, const fm_error *err);
void arguments_free(fm_arguments *arguments);
/* Opens the plugins and expands the arguments. Several specs make one plan: equal cases are one,
 * with the most launches, frames and warm-up that any of them wants. specs end with NULL; none: no
 * spec. */
fm_status arguments_plan(fm_plan *plan, fm_plugin_list *plugins, const fm_arguments *arguments,
                         const char *const *specs, fm_error *err);

/* Leaves of a plan what --shard asks for. FM_INVALID, FM_NO_MEMORY. */
fm_status arguments_shard(fm_plan *plan, const fm_arguments *arguments, fm_error *err);

/* Finds the plugins; folders: those of --plugin-dir. None is ever loaded into this process. */
fm_status cli_find_plugins(fm_plugin_list *plugins, const fm_text_list *folders, fm_error *err);
/* A line for each plugin that is refused and no case of the plan: it was to be one of all. */
void cli_tell_left_out(FILE *talk, const fm_plan *plan, const fm_plugin_list *plugins);

/* One spec alone, for plugins that were found. */
fm_status arguments_expand(fm_plan *plan, const fm_plugin_list *plugins,
                           const fm_arguments *arguments, const char *spec, fm_error *err);

/* Figure files in the folders of base/data.h; the first of an id wins. */
typedef struct fm_figure {
    char id[64]; /* the file's name without .yml */
    char path[FM_PATH_MAX_BYTES];
    char title[256];
    bool has_pictures; /* `pictures: true`: those of its cases are kept */
} fm_figure;
typedef struct fm_figure_list {
    fm_figure *figures; /* by id */
    size_t count;
} fm_figure_list;
fm_status figures_list(fm_figure_list *list, fm_error *err);
void figures_free(fm_figure_list *list);
/* Adds the ids of the figure's claims; a damaged file has none. FM_NO_MEMORY. */
fm_status figure_add_claims(fm_text_list *names, const fm_figure *figure, fm_error *err);
/* Whether the figure makes the claim of this id. */
bool figure_has_claim(const fm_figure *figure, const char *claim);
/* How much of a figure is measured: its `run`; `smoke` over it; or `large` too, which takes a
 * software rasteriser hours. */
typedef enum fm_figure_size { FM_FIGURE_FULL, FM_FIGURE_SMOKE, FM_FIGURE_LARGE } fm_figure_size;
/* Writes what a figure runs as spec files in folder, one for each block of `run` (a mapping, or a
 * list of them), and adds their paths. FM_UNSUPPORTED: the figure has no `run`. */
fm_status figure_write_specs(fm_text_list *paths, const char *folder, const fm_figure *figure,
                             fm_figure_size size, fm_error *err);

/* What run and reproduce end with; all of it is borrowed. */
typedef struct cli_run_desc {
    const char *directory;
    const char *command; /* for the manifest */
    const fm_plan *plan; /* without a case: a reproduction of tables alone */
    const fm_plugin_list *plugins;
    const char *const *figures;  /* ids; ends with NULL */
    const fm_text *figure_cases; /* figures.csv; NULL: none */
    const fm_text *memory;       /* memory.csv, which the report shows; NULL or empty: none */
} cli_run_desc;
/* The plan is run, reported and summed up. */
int cli_run_plan(const fm_arguments *arguments, const cli_run_desc *desc);
/* A line for each reason why cases of the run in this folder are not ok, then one for each message
 * of those that are, each once, the first few. */
void cli_reasons(FILE *talk, const char *directory);
/* -o, or out-UTC. */
void cli_directory(char directory[FM_PATH_MAX_BYTES], const fm_arguments *arguments);
/* The user's cache; "": none is to be used. */
void cli_cache(char folder[FM_PATH_MAX_BYTES], const fm_arguments *arguments);
/* DIR/specs: what was run, for the record. */
void cli_keep_specs(const fm_text_list *paths, const char *directory);
/* Adds a word, quoted where a shell needs it. */
void cli_add_word(fm_text *text, const char *word);
/* The words of a command line, quoted where a shell needs it; the caller frees it. NULL: no memory
 */
char *cli_command_text(int argc, char **argv);

/* Path of fragmark-report, beside the program or in PATH; false: there is none. */
bool report_find(char path[FM_PATH_MAX_BYTES]);
/* Executes it on a folder; its exit status, or -1 when it could not be executed.
 * reference  another machine's results; NULL: none of its own choice
 * error      the metric that is held against time; NULL: the default */
int report_execute(const char *program, const char *directory, const char *reference,
                   const char *error);
/* Draws what a run or a merge ends with: CLI_DONE, CLI_CLAIM_FAILS, or CLI_INCOMPLETE: the results
 * are there, and the report is not, or it was drawn and lacks something, which the program has
 * told. reference: as above. */
int cli_draw_report(const fm_cli *cli, const char *directory, const char *reference);
/* Executes argv[0], which report_find has found, with arguments that end with NULL; the same. */
int report_command(const char *const *argv);
/* Before anything is measured: FM_INVALID or FM_IO if the reference that is asked for, or a figure
 * that the report is to draw, cannot be read. Says so if there is no fragmark-report. figures: ids,
 * ends with NULL. */
fm_status report_expect(const fm_arguments *arguments, const char *const *figures, fm_error *err);
/* A command of that program, whose options are its own: its exit code, or CLI_NOTHING, told, where
 * it cannot be executed. argv[0] is left out. */
int report_pass_on(const fm_cli *cli, const char *command, int argc, char **argv);
/* Why there is no fragmark-report here: the beginning of a sentence. */
const char *report_missing(void);

#endif
