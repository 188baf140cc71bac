/* fragmark-report: arguments, exit codes, and the only place that prints. */
#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/data.h"
#include "baseline_command.h"
#include "claims/verdicts.h"
#include "compare_command.h"
#include "error_command.h"
#include "gate_command.h"
#include "history_command.h"
#include "model/exit_code.h"
#include "night_command.h"
#include "page/report.h"
#include "results_folder.h"

enum { KEY_CHECK = 512 };

typedef struct arguments {
    const char *directory;
    fm_text_list figures;
    const char *reference; /* NULL: not given */
    const fm_error_kind *error;
    bool only_checks;
} arguments;

static error_t parse(int key, char *value, struct argp_state *state)
{
    arguments *given = state->input;
    const char *nearest = NULL;
    switch (key) {
    case 'f':
        return text_list_add(&given->figures, value) ? 0 : ENOMEM;
    case 'r':
        given->reference = value;
        return 0;
    case 'e':
        given->error = error_kind_find(value, &nearest);
        if (given->error == NULL)
            argp_error(state, "--error %s: the nearest is '%s'", value, nearest);
        return 0;
    case KEY_CHECK:
        given->only_checks = true;
        return 0;
    case ARGP_KEY_ARG:
        if (given->directory != NULL)
            argp_error(state, "one directory at a time; \"%s\" is a second one", value);
        given->directory = value;
        return 0;
    case ARGP_KEY_END:
        if (given->directory == NULL && !given->only_checks)
            argp_error(state, "which directory? One that `fragmark run -o DIR` has written");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

/* Where a figure's file is: the argument itself, or an id in the folders that hold figures. */
static fm_status find_figure(char path[FM_PATH_MAX_BYTES], const char *name, fm_error *err)
{
    if (strchr(name, '/') == NULL && strchr(name, '.') == NULL)
        return data_find(path, DATA_FIGURES, name, ".yml", err);
    if (strlen(name) >= FM_PATH_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "figure %.64s...: too long a path", name);
    strcpy(path, name);
    return FM_OK;
}

/* The run says which figures it is for; those asked for on the command line come instead. Without
 * one of them the report would lack its charts and claims, and replace one that has them. */
static fm_status take_figures_of_run(arguments *given, const fm_provenance *manifest, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    for (size_t i = 0; i < manifest->figure_count; i++) {
        if (find_figure(path, manifest->figures[i], err) != FM_OK)
            return fm_error_prefix(
                err,
                "%s was measured for a figure that is not here (`fragmark-report --figure` "
                "names those to draw instead)",
                given->directory);
        if (!text_list_add(&given->figures, manifest->figures[i]))
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu figures", manifest->figure_count);
    }
    return FM_OK;
}

static fm_status read_figures(fm_paper_figure **figures, const arguments *given, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    if (figures == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu figures", given->figures.count);
    for (size_t i = 0; i < given->figures.count; i++) {
        fm_status status = find_figure(path, given->figures.items[i], err);
        if (status == FM_OK)
            status = paper_figure_read(&figures[i], path, err);
        if (status != FM_OK)
            return status;
    }
    return FM_OK;
}

static void close_figures(fm_paper_figure **figures, const arguments *given)
{
    for (size_t i = 0; figures != NULL && i < given->figures.count; i++)
        paper_figure_close(figures[i]);
    free(figures);
}

/* Another machine's results: a folder, or the name of one of ours. */
static fm_status open_reference(fm_result_files **reference, char path[FM_PATH_MAX_BYTES],
                                const arguments *given, fm_error *err)
{
    const char *name = given->reference != NULL ? given->reference : "h100";
    *reference = NULL;
    if (strcmp(name, "none") == 0)
        return FM_OK;
    if (strchr(name, '/') != NULL)
        return results_folder_check(name, err) != FM_OK ? FM_INVALID
                                                        : result_files_read(reference, name, err);
    const fm_status status = data_find(path, DATA_REFERENCES, name, "", err);
    if (status != FM_OK)
        return fm_error_prefix(err, "--reference none does without");
    return result_files_read(reference, path, err);
}

/* A run is no other machine's reference of itself. */
static void drop_own_reference(fm_result_files **reference, const fm_result_files *results)
{
    const char *run_id = provenance_fact(results->manifest, "run_id");
    if (*reference == NULL || run_id[0] == '\0' ||
        strcmp(provenance_fact((*reference)->manifest, "run_id"), run_id) != 0)
        return;
    result_files_close(*reference);
    *reference = NULL;
}

/* A line for each basis: what was calibrated to hold adds nothing to what holds. */
static void tell_claims(const fm_claim_results *verdicts)
{
    const fm_verdict_counts counts = verdicts_count(verdicts, NULL);
    for (int basis = 0; basis < FM_BASIS_COUNT; basis++) {
        if (!verdict_counts_has(&counts, (fm_claim_basis)basis))
            continue;
        fprintf(stderr, "claims, %s:", claim_basis_name((fm_claim_basis)basis));
        for (int kind = 0; kind < FM_VERDICT_COUNT; kind++)
            fprintf(stderr, "%s %zu %s", kind == 0 ? "" : ",", counts.counts[basis][kind],
                    verdict_name((fm_verdict_kind)kind));
        fputc('\n', stderr);
    }
}

static int tell(const arguments *given, const fm_report_outcome *outcome,
                const fm_claim_results *verdicts, fm_error *err)
{
    const size_t failed = verdicts_required_failed(verdicts);
    fprintf(stderr, "%zu chart%s, %zu picture%s", outcome->chart_count,
            outcome->chart_count == 1 ? "" : "s", outcome->picture_count,
            outcome->picture_count == 1 ? "" : "s");
    fputc('\n', stderr);
    tell_claims(verdicts);
    printf("%s/report.html\n", given->directory);
    if (outcome->unexplained_count > 0)
        fprintf(stderr,
                "%zu case%s with errors that no trait of the method explains: see the "
                "report's part on stability\n",
                outcome->unexplained_count, outcome->unexplained_count == 1 ? "" : "s");
    if (failed > 0)
        fm_fail(err, FM_OK, "%zu claim%s that must hold fail%s: see claims.csv", failed,
                failed == 1 ? "" : "s", failed == 1 ? "s" : "");
    return failed == 0 ? FM_EXIT_DONE : FM_EXIT_CLAIM_FAILS;
}

/* Whose fault it is that a report cannot be written: the disk's, or a file's that it is made of. */
static int writing_code(fm_status status)
{
    return status == FM_IO || status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_DAMAGED;
}

/* Judges, draws, and puts all in place. */
static int write_report(const arguments *given, const fm_report_desc *base, fm_error *err)
{
    fm_claim_results verdicts = { 0 };
    fm_report_outcome outcome;
    fm_report_desc report = *base;
    const fm_verdicts_desc desc = { .results = report.results,
                                    .reference = report.reference,
                                    .figures = report.figures,
                                    .figure_count = report.figure_count };
    report.verdicts = &verdicts;
    fm_status status = verdicts_make(&verdicts, &desc, err);
    if (status == FM_OK)
        status = report_write(&outcome, &report, err);
    const int code = status == FM_OK ? tell(given, &outcome, &verdicts, err) : writing_code(status);
    verdicts_free(&verdicts);
    if (code != FM_EXIT_DONE || report.results->missing.count == 0)
        return code;
    fm_fail(err, FM_OK, "%s", report.results->missing.items[0]);
    return FM_EXIT_INCOMPLETE;
}

/* What was named on the command line and is not there is wrong use; what the run or the report
 * needs of itself is a file that is gone. */
static int make_report(arguments *given, fm_error *err)
{
    int code = FM_EXIT_DAMAGED;
    char reference_path[FM_PATH_MAX_BYTES]; /* lives as long as what is read from there */
    fm_result_files *results = NULL, *reference = NULL;
    fm_paper_figure **figures = NULL;
    const bool has_named = given->figures.count > 0;
    if (results_folder_check(given->directory, err) != FM_OK)
        return FM_EXIT_USAGE;
    if (result_files_read(&results, given->directory, err) != FM_OK)
        goto out;
    if (open_reference(&reference, reference_path, given, err) != FM_OK) {
        code = given->reference != NULL ? FM_EXIT_USAGE : FM_EXIT_DAMAGED;
        goto out;
    }
    drop_own_reference(&reference, results);
    if (!has_named && take_figures_of_run(given, results->manifest, err) != FM_OK)
        goto out;
    figures = calloc(given->figures.count + 1, sizeof *figures);
    if (read_figures(figures, given, err) != FM_OK) {
        code = has_named ? FM_EXIT_USAGE : FM_EXIT_DAMAGED;
        goto out;
    }
    const fm_report_desc desc = { .results = results,
                                  .reference = reference,
                                  .draws_reference = given->reference != NULL,
                                  .figures = (const fm_paper_figure *const *)figures,
                                  .figure_count = given->figures.count,
                                  .error = given->error };
    code = write_report(given, &desc, err);
out:
    close_figures(figures, given);
    result_files_close(reference);
    result_files_close(results);
    return code;
}

/* Whether the figures and the reference that are asked for can be read: known before a long run. */
static int check(const arguments *given, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_result_files *reference = NULL;
    fm_paper_figure **figures = calloc(given->figures.count + 1, sizeof *figures);
    const bool is_right = read_figures(figures, given, err) == FM_OK &&
                          open_reference(&reference, path, given, err) == FM_OK;
    close_figures(figures, given);
    result_files_close(reference);
    return is_right ? FM_EXIT_DONE : FM_EXIT_USAGE;
}

/* Commands that `fragmark` hands on, with options of their own. */
static const struct {
    const char *name;
    int (*run)(int argc, char **argv);
} commands[] = {
    { "error", error_main }, { "compare", compare_main }, { "baseline", baseline_main },
    { "gate", gate_main },   { "history", history_main }, { "night", night_main },
};

static int run_command(const char *name, int (*run)(int argc, char **argv), int argc, char **argv)
{
    char title[64]; /* what argp calls the command */
    snprintf(title, sizeof title, "fragmark %s", name);
    argv[1] = title;
    return run(argc - 1, argv + 1);
}

int main(int argc, char **argv)
{
    static const struct argp_option options[] = {
        { "figure", 'f', "FIGURE", 0,
          "Draw this figure of a paper: a file, or an id such as kplus-05. May be given again. "
          "Without it: the figures that the run was made for",
          0 },
        { "reference", 'r', "NAME|DIR|none", 0,
          "Another machine's results: curves beside ours in all charts (without this option in "
          "ratios only), and verdicts on what this machine cannot test; h100",
          0 },
        { "error", 'e', "METRIC", 0,
          "What is held against time: total_rmse (the default), total_flip, total_ssim, "
          "total_max_abs, all against the picture of all fragments; rmse, flip, ssim, max_abs, or "
          "these over covered pixels (covered_rmse, ...), without what keeping only k costs",
          0 },
        { "check", KEY_CHECK, NULL, 0,
          "Only say whether these figures and this reference can be read", 0 },
        { 0 },
    };
    static const struct argp argp = {
        .options = options,
        .parser = parse,
        .args_doc = "DIR",
        .doc = "Draws charts and writes report.html from the results in DIR.\v"
               "Reads DIR/manifest.json, summary.csv, samples.csv and images/; measures nothing. "
               "Writes DIR/charts/*.svg and *.png, DIR/images/*.png, *.exr and heat maps, "
               "DIR/tradeoff.csv, DIR/stability.csv, and DIR/report.html, one file that opens "
               "anywhere. Prints its "
               "path.\n\n"
               "Examples:\n"
               "  fragmark-report out/kplus-05\n"
               "  fragmark-report out/mine --figure kplus-05\n"
               "  fragmark-report out/mine --figure my-figure.yml\n"
               "  fragmark-report error IMAGE REFERENCE   (its own --help tells more)\n"
               "  fragmark-report compare BASE NEW        (the same)\n"
               "  fragmark-report history add DIR         (the same)\n\n"
               "Exit status: 0 done, 1 a claim that its figure declares required fails, 2 wrong "
               "use: a figure or reference that is named and not there, or a bad figure file, "
               "5 the report cannot be written, or was drawn of results that lack something, which "
               "its first lines say, 8 damaged or foreign results, or figures of the run that are "
               "gone. After 2 and 8, and where writing failed, the report that was there is as it "
               "was.",
    };
    arguments given = { .error = error_kind_find(NULL, NULL) };
    fm_error err = { 0 };
    for (size_t i = 0; i < sizeof commands / sizeof commands[0] && argc > 1; i++)
        if (strcmp(argv[1], commands[i].name) == 0)
            return run_command(commands[i].name, commands[i].run, argc, argv);
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const int code = given.only_checks ? check(&given, &err) : make_report(&given, &err);
    text_list_free(&given.figures);
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark-report: %s\n", err.message);
    return code;
}
