#include "gate_command.h"

#include <argp.h>
#include <stdio.h>

#include "base/text.h"
#include "compare/comparison.h"
#include "model/exit_code.h"
#include "results_folder.h"

typedef struct gate_arguments {
    const char *directories[2]; /* BASE, NEW */
    int directory_count;
} gate_arguments;

static error_t parse(int key, char *value, struct argp_state *state)
{
    gate_arguments *given = state->input;
    switch (key) {
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

static const struct argp argp = {
    .parser = parse,
    .args_doc = "BASE NEW",
    .doc =
        "Of two folders of results: is the status of a case worse, or does it take more bytes, or "
        "make more errors? Times are not judged: `fragmark compare` shows them.\v"
        "Exit codes: 0 nothing is worse; 1 a case is worse; 2 wrong use, or a folder that holds "
        "no results; 5 something cannot be read or printed; 7 no case in both; 8 damaged or "
        "foreign results.",
};

static bool is_worse(const fm_compared *compared)
{
    for (size_t i = 0; i < compared->changes.count; i++)
        if (exact_order(&compared->changes.items[i]) < 0)
            return true;
    return false;
}

static void add_case(fm_text *text, const fm_compared *compared, bool is_worse_now)
{
    char name[FM_COMPARED_NAME_BYTES];
    compared_name(name, compared->pair.base);
    text_add(text, "%-8s%s; ", is_worse_now ? "worse" : "differs", name);
    compared_add_changes(text, compared);
    text_add(text, "\n");
}

static int judge(const fm_comparison *comparison)
{
    fm_text text = { 0 };
    size_t worse = 0, differing = 0;
    for (size_t i = 0; i < comparison->count; i++) {
        const bool is_worse_now = is_worse(&comparison->cases[i]);
        worse += is_worse_now;
        differing += !is_worse_now && comparison->cases[i].changes.count > 0;
        if (comparison->cases[i].changes.count > 0)
            add_case(&text, &comparison->cases[i], is_worse_now);
    }
    text_add(
        &text,
        "%zu case%s: %zu worse, %zu that differ and are not worse, %zu equal; %zu only in BASE, "
        "%zu only in NEW; times were not judged\n",
        comparison->count, comparison->count == 1 ? "" : "s", worse, differing,
        comparison->count - worse - differing, comparison->only_base, comparison->only_now);
    const bool is_printed =
        !text.failed && fwrite(text.bytes, 1, text.length, stdout) > 0 && fflush(stdout) == 0;
    text_free(&text);
    if (!is_printed)
        return FM_EXIT_INCOMPLETE;
    return worse > 0 ? FM_EXIT_WORSE : FM_EXIT_DONE;
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

static int gate(fm_result_files *const runs[2], fm_error *err)
{
    fm_comparison comparison = { 0 };
    const fm_comparison_desc desc = { .base = runs[0], .now = runs[1] };
    const fm_status status = comparison_make(&comparison, &desc, err);
    int code = status == FM_UNSUPPORTED ? FM_EXIT_OTHER_CODE : FM_EXIT_INCOMPLETE;
    if (status == FM_OK)
        code = judge(&comparison);
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
        code = gate(runs, &err);
    for (int i = 0; i < 2; i++)
        result_files_close(runs[i]);
    if (code != FM_EXIT_DONE && code != FM_EXIT_WORSE)
        fprintf(stderr, "fragmark gate: %s\n", err.message);
    return code;
}
