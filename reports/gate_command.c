#include "gate_command.h"

#include <argp.h>
#include <stdio.h>

#include "base/text.h"
#include "compare/comparison.h"
#include "model/exit_code.h"
#include "print_text.h"
#include "results_folder.h"

typedef struct gate_arguments {
    const char *directories[2]; /* BASE, NEW */
    int directory_count;
    const char *csv; /* NULL: not asked for */
    bool wants_json;
} gate_arguments;

enum { KEY_CSV = 512, KEY_JSON };

static error_t parse(int key, char *value, struct argp_state *state)
{
    gate_arguments *given = state->input;
    switch (key) {
    case KEY_CSV:
        given->csv = value;
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
            argp_error(state, "which folders? BASE and NEW");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "csv", KEY_CSV, "FILE", 0, "also write a row a case", 0 },
    { "json", KEY_JSON, NULL, 0, "print JSON instead of lines", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "BASE NEW",
    .doc =
        "Of two folders of results: is the status of a case worse, or does it take more bytes, or "
        "make more errors? Times are not judged: `fragmark compare` shows them.\v"
        "Exit codes: 0 nothing is worse; 1 a case is worse; 2 wrong use, or a folder that holds "
        "no results; 5 something cannot be read, written or printed; 7 no case in both; 8 damaged "
        "or foreign results.",
};

static void add_case(fm_text *text, const fm_compared *compared, fm_exact_verdict verdict)
{
    char name[FM_COMPARED_NAME_BYTES];
    compared_name(name, compared->pair.base);
    text_add(text, "%-8s%s; ", exact_verdict_name(verdict), name);
    compared_add_changes(text, compared);
    text_add(text, "\n");
}

static void add_lines(fm_text *text, const fm_comparison *comparison)
{
    for (size_t i = 0; i < comparison->count; i++) {
        const fm_exact_verdict verdict = exact_verdict(&comparison->cases[i].changes);
        if (verdict != FM_EXACT_EQUAL)
            add_case(text, &comparison->cases[i], verdict);
    }
    text_add(text,
             "%zu case%s: %zu worse, %zu that differ and are not worse, %zu equal; %zu only in "
             "BASE, %zu only in NEW; times were not judged\n",
             comparison->count, comparison->count == 1 ? "" : "s",
             comparison_exact(comparison, FM_EXACT_WORSE),
             comparison_exact(comparison, FM_EXACT_DIFFERS),
             comparison_exact(comparison, FM_EXACT_EQUAL), comparison->only_base,
             comparison->only_now);
}

static fm_status write_csv(const char *path, const fm_comparison *comparison, fm_error *err)
{
    fm_text csv = { 0 };
    comparison_add_exact_csv(&csv, comparison);
    const fm_status status = csv.failed ? fm_fail(err, FM_NO_MEMORY, "%s: no memory", path)
                                        : text_write_file(path, csv.bytes, csv.length, err);
    text_free(&csv);
    return status;
}

static int judge(const gate_arguments *given, const fm_comparison *comparison, fm_error *err)
{
    fm_text text = { 0 };
    fm_status status = given->csv != NULL ? write_csv(given->csv, comparison, err) : FM_OK;
    if (status == FM_OK && given->wants_json)
        status = comparison_add_exact_json(&text, comparison, err);
    else if (status == FM_OK)
        add_lines(&text, comparison);
    if (print_text(&text, status, err) != FM_OK)
        return FM_EXIT_INCOMPLETE;
    return comparison_exact(comparison, FM_EXACT_WORSE) > 0 ? FM_EXIT_WORSE : FM_EXIT_DONE;
}

static int read_runs(fm_result_files *runs[2], const gate_arguments *given, fm_error *err)
{
    for (int i = 0; i < 2; i++)
        if (results_folder_check(given->directories[i], err) != FM_OK)
            return FM_EXIT_USAGE;
    for (int i = 0; i < 2; i++)
        if (result_files_read(&runs[i], given->directories[i], err) != FM_OK)
            return err->status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_DAMAGED;
    return FM_EXIT_DONE;
}

static int gate(const gate_arguments *given, fm_result_files *const runs[2], fm_error *err)
{
    fm_comparison comparison = { 0 };
    const fm_comparison_desc desc = { .base = runs[0], .now = runs[1] };
    const fm_status status = comparison_make(&comparison, &desc, err);
    int code = status == FM_UNSUPPORTED ? FM_EXIT_OTHER_CODE : FM_EXIT_INCOMPLETE;
    if (status == FM_OK)
        code = judge(given, &comparison, err);
    comparison_free(&comparison);
    return code;
}

int gate_main(int argc, char **argv)
{
    gate_arguments given = { .directory_count = 0 };
    fm_result_files *runs[2] = { NULL, NULL };
    fm_error err = { 0 };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    int code = read_runs(runs, &given, &err);
    if (code == FM_EXIT_DONE)
        code = gate(&given, runs, &err);
    for (int i = 0; i < 2; i++)
        result_files_close(runs[i]);
    if (code != FM_EXIT_DONE && code != FM_EXIT_WORSE)
        fprintf(stderr, "fragmark gate: %s\n", err.message);
    return code;
}
