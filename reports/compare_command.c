#include "compare_command.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "base/state.h"
#include "base/text.h"
#include "baseline/baseline.h"
#include "compare/comparison.h"
#include "model/exit_code.h"
#include "page/comparison_page.h"
#include "print_text.h"
#include "results_folder.h"

typedef struct compare_arguments {
    const char *directories[2]; /* BASE, NEW */
    int directory_count;
    fm_quantity_desc quantity;
    double band;
    const char *csv, *html; /* NULL: not asked for */
    const char *state;      /* NULL: the usual folder */
    bool wants_json;
    char baseline[FM_PATH_MAX_BYTES]; /* where BASE is, if it is one */
} compare_arguments;

enum { KEY_CSV = 512, KEY_HTML, KEY_JSON, KEY_STATE };

static const char baseline_prefix[] = "baseline:";

/* "2" and "2%" are the same. */
static void take_band(compare_arguments *given, const char *text, struct argp_state *state)
{
    char number[32];
    double percent = 0.0;
    const size_t length = strlen(text);
    const bool has_sign = length > 0 && text[length - 1] == '%';
    snprintf(number, sizeof number, "%.*s", (int)(length - has_sign), text);
    if (length >= sizeof number || !text_to_double(&percent, number) || percent < 0 ||
        percent > 100)
        argp_error(state, "--band %.40s: a share in percent, from 0 to 100", text);
    given->band = percent / 100.0;
}

static error_t parse(int key, char *value, struct argp_state *state)
{
    compare_arguments *given = state->input;
    switch (key) {
    case 'm':
        given->quantity.metric = value;
        return 0;
    case 'r':
        given->quantity.reference = value;
        return 0;
    case 'b':
        take_band(given, value, state);
        return 0;
    case KEY_CSV:
        given->csv = value;
        return 0;
    case KEY_HTML:
        given->html = value;
        return 0;
    case KEY_STATE:
        given->state = value;
        return 0;
    case KEY_JSON:
        given->wants_json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (given->directory_count == 2)
            argp_error(state, "two folders; '%s' is a third one", value);
        given->directories[given->directory_count++] = value;
        return 0;
    case ARGP_KEY_END:
        if (given->directory_count < 2)
            argp_error(state, "which folders? BASE and NEW, each one that `fragmark run -o DIR` "
                              "has written");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "metric", 'm', "METRIC", 0,
      "what is compared: a time of frames (frame_ms, the default, store_ms, frame_wall_ms, "
      "pass.NAME_ms, ...) or times_floor",
      0 },
    { "reference", 'r', "METHOD|floor|none", 0,
      "over what it is taken, within each run: the time of a method on the same workload; the "
      "floor's in the same launch; or nothing. Without this option: nothing, if both runs are of "
      "one machine and day or --metric is given; else floor",
      0 },
    { "band", 'b', "PERCENT", 0, "how much does not count: 2%, the default", 0 },
    { "csv", KEY_CSV, "FILE", 0, "also write a row a case", 0 },
    { "html", KEY_HTML, "FILE", 0, "also write a page with a chart, one file that opens anywhere",
      0 },
    { "state", KEY_STATE, "DIR", 0,
      "where baselines are; without it $XDG_STATE_HOME/fragmark, or ~/.local/state/fragmark", 0 },
    { "json", KEY_JSON, NULL, 0, "print JSON instead of lines", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "BASE NEW",
    .doc = "Compares two folders of results, case by case, the worst first: times, status, memory, "
           "errors, code and machine. It advises, and fails nothing.\v"
           "Cases are joined by id, or else by what names them: method, options that are not "
           "defaults, scene, device, feed and keys.\n\n"
           "Ratios are NEW over BASE, each the median of its launches, with a 95 % interval. "
           "Verdicts: same, if the whole interval lies within the band; slower or faster, if it "
           "lies beside 1 and the ratio is beyond the band; else unclear, as are rows that are "
           "noisy or had one launch. Two launches are judged, by a very wide interval: measure "
           "three at least. Of a hundred equal cases up to five may come out as slower "
           "or faster: measure again before you believe one.\n\n"
           "Status, memory, counts of fragments and errors are compared exactly (errors up to "
           "rounding). Where the code differs, it says whether program, driver, plugin or "
           "shaders.\n\n"
           "Milliseconds of two machines are never compared; ratios within each run are. Machines "
           "are the same if processor, cores, memory and devices have the same names.\n\n"
           "Examples:\n"
           "  fragmark compare monday tuesday\n"
           "  fragmark compare main mine --csv mine.csv --html mine.html\n"
           "  fragmark compare here there --reference ab-ll\n"
           "  fragmark compare baseline:release-1 mine     (`fragmark baseline --help`)\n\n"
           "Exit codes: 0 compared, whatever was found; 2 wrong use, a folder that holds no "
           "results, or no such baseline of this machine; 5 something cannot be written; 7 not "
           "comparable: milliseconds of two "
           "machines, or no case in both; 8 damaged or foreign results, or a baseline that was "
           "changed.",
};

static int code_of(fm_status status)
{
    switch (status) {
    case FM_INVALID:
        return FM_EXIT_USAGE;
    case FM_UNSUPPORTED:
        return FM_EXIT_OTHER_CODE;
    default:
        return FM_EXIT_INCOMPLETE;
    }
}

static void tell_missing(const fm_result_files *results)
{
    for (size_t i = 0; i < results->missing.count; i++)
        fprintf(stderr, "fragmark compare: %s: %s\n", results->directory,
                results->missing.items[i]);
}

static int read_run(fm_result_files **run, const char *directory, fm_error *err)
{
    if (results_folder_check(directory, err) != FM_OK)
        return FM_EXIT_USAGE;
    if (result_files_read(run, directory, err) != FM_OK)
        return err->status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_DAMAGED;
    tell_missing(*run);
    return FM_EXIT_DONE;
}

/* baseline:NAME becomes the folder of that baseline, of NEW's machine. */
static int find_baseline(compare_arguments *given, const fm_result_files *now, fm_error *err)
{
    char store[FM_PATH_MAX_BYTES];
    const size_t length = strlen(baseline_prefix);
    if (strncmp(given->directories[0], baseline_prefix, length) != 0)
        return FM_EXIT_DONE;
    if (state_path(store, given->state, "baselines", false, err) != FM_OK)
        return FM_EXIT_USAGE;
    const fm_status status =
        baseline_find(given->baseline, store, given->directories[0] + length, now->manifest, err);
    given->directories[0] = given->baseline;
    switch (status) {
    case FM_OK:
        return FM_EXIT_DONE;
    case FM_UNSUPPORTED:
        return FM_EXIT_USAGE;
    case FM_INVALID:
        return FM_EXIT_DAMAGED;
    default:
        return FM_EXIT_INCOMPLETE;
    }
}

/* A folder that is not there is told before one is read. */
static int read_runs(fm_result_files *runs[2], compare_arguments *given, fm_error *err)
{
    int code = FM_EXIT_DONE;
    for (int i = 0; i < 2 && code == FM_EXIT_DONE; i++)
        if (strncmp(given->directories[i], baseline_prefix, strlen(baseline_prefix)) != 0 &&
            results_folder_check(given->directories[i], err) != FM_OK)
            code = FM_EXIT_USAGE;
    if (code == FM_EXIT_DONE)
        code = read_run(&runs[1], given->directories[1], err);
    if (code == FM_EXIT_DONE)
        code = find_baseline(given, runs[1], err);
    return code == FM_EXIT_DONE ? read_run(&runs[0], given->directories[0], err) : code;
}

static fm_status write_csv(const char *path, const fm_comparison *comparison, fm_error *err)
{
    fm_text csv = { 0 };
    comparison_add_csv(&csv, comparison);
    const fm_status status = csv.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                                        : text_write_file(path, csv.bytes, csv.length, err);
    text_free(&csv);
    return status;
}

static fm_status print(const compare_arguments *given, const fm_comparison *comparison,
                       fm_error *err)
{
    fm_text text = { 0 };
    fm_status status = FM_OK;
    if (given->wants_json)
        status = comparison_add_json(&text, comparison, err);
    else
        comparison_add_lines(&text, comparison);
    return print_text(&text, status, err);
}

static int compare(const compare_arguments *given, fm_result_files *const runs[2], fm_error *err)
{
    fm_comparison comparison = { 0 };
    const fm_comparison_desc desc = {
        .base = runs[0], .now = runs[1], .quantity = given->quantity, .band = given->band
    };
    fm_status status = comparison_make(&comparison, &desc, err);
    int code = status == FM_OK ? FM_EXIT_DONE : code_of(status);
    if (status == FM_OK && given->csv != NULL)
        status = write_csv(given->csv, &comparison, err);
    if (status == FM_OK && given->html != NULL)
        status = comparison_page_write(given->html, &comparison, err);
    if (status == FM_OK)
        status = print(given, &comparison, err);
    if (status != FM_OK && code == FM_EXIT_DONE)
        code = FM_EXIT_INCOMPLETE;
    comparison_free(&comparison);
    return code;
}

int compare_main(int argc, char **argv)
{
    compare_arguments given = { .band = 0.02 };
    fm_result_files *runs[2] = { NULL, NULL };
    fm_error err = { 0 };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    int code = read_runs(runs, &given, &err);
    if (code == FM_EXIT_DONE)
        code = compare(&given, runs, &err);
    for (int i = 0; i < 2; i++)
        result_files_close(runs[i]);
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark compare: %s\n", err.message);
    return code;
}
