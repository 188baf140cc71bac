#include "night_command.h"

#include <argp.h>
#include <errno.h>
#include <stdio.h>
#include <string.h>

#include "base/state.h"
#include "baseline/baseline.h"
#include "history/record.h"
#include "history/runs.h"
#include "model/exit_code.h"
#include "night/gate.h"
#include "night/night.h"
#include "page/history_page.h"
#include "results_folder.h"

typedef struct night_arguments {
    const char *run, *state, *output, *baseline, *reference, *gate, *unconfirmed;
    double effect;
    fm_text_list notes;
} night_arguments;

/* What is open while a night is judged. */
typedef struct session {
    night_arguments *given;
    fm_result_files *now, *baseline;
    fm_gate_answers answers; /* of the gate, if there is one */
    fm_history *history;
    char history_path[FM_PATH_MAX_BYTES], baseline_path[FM_PATH_MAX_BYTES];
    fm_error *err;
} session;

enum { KEY_STATE = 512, KEY_BASELINE, KEY_EFFECT, KEY_NOTE, KEY_GATE, KEY_UNCONFIRMED };

static error_t parse(int key, char *value, struct argp_state *state)
{
    night_arguments *given = state->input;
    switch (key) {
    case 'o':
        given->output = value;
        return 0;
    case 'r':
        given->reference = value;
        return 0;
    case KEY_STATE:
        given->state = value;
        return 0;
    case KEY_BASELINE:
        given->baseline = value;
        return 0;
    case KEY_EFFECT:
        if (!text_to_double(&given->effect, value) || given->effect <= 1)
            argp_error(state, "--effect %.40s: a factor above 1, such as 1.06", value);
        return 0;
    case KEY_GATE:
        given->gate = value;
        return 0;
    case KEY_UNCONFIRMED:
        given->unconfirmed = value;
        return 0;
    case KEY_NOTE:
        return text_list_add(&given->notes, value) ? 0 : ENOMEM;
    case ARGP_KEY_ARG:
        if (given->run != NULL)
            argp_error(state, "one folder at a time; '%s' is a second one", value);
        given->run = value;
        return 0;
    case ARGP_KEY_END:
        if (given->run == NULL || given->output == NULL)
            argp_error(state, "which run, and -o DIR for what is said of it?");
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "output", 'o', "DIR", 0, "where summary.md, junit.xml, history.html and night.json go", 0 },
    { "state", KEY_STATE, "DIR", 0,
      "where the history and the baselines are; without it $XDG_STATE_HOME/fragmark, or "
      "~/.local/state/fragmark",
      0 },
    { "baseline", KEY_BASELINE, "NAME", 0, "also hold the run against this baseline", 0 },
    { "reference", 'r', "METHOD|floor", 0, "over what frame_ms is taken; floor", 0 },
    { "effect", KEY_EFFECT, "FACTOR", 0,
      "how many launches a night find a step of this factor is told; 1.06", 0 },
    { "gate", KEY_GATE, "FILE", 0,
      "ab.csv of a `fragmark gate` of these cases: findings on time that it does not call worse "
      "are "
      "dismissed; without it they stand",
      0 },
    { "unconfirmed", KEY_UNCONFIRMED, "TEXT", 0,
      "a sentence for the summary if a finding on time is not confirmed: why", 0 },
    { "note", KEY_NOTE, "TEXT", 0, "a sentence for the summary; repeatable", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "RUN",
    .doc = "Records the results in RUN in the history, and says what became worse: times by the "
           "alarms of their series, status, memory and errors exactly. `fragmark nightly` does "
           "this after it has measured; with results that were measured otherwise it can be done "
           "alone.\v"
           "Examples:\n"
           "  fragmark-report night out/tonight -o out/tonight-said\n"
           "  fragmark-report night out/tonight -o out/tonight-said --gate out/gate/ab.csv\n\n"
           "Exit codes: 0 quiet; 1 alarm; 2 wrong use, or a reference that the history does not "
           "have; 4 cases failed, and nothing says that they did before; 5 something cannot be "
           "written; 8 a damaged or foreign history, baseline, or results.",
};

/* A night does without a baseline that nobody has set on this machine, and says so. */
static fm_status open_baseline(session *with)
{
    char store[FM_PATH_MAX_BYTES];
    const char *name = with->given->baseline;
    if (name == NULL)
        return FM_OK;
    fm_status status = state_path(store, with->given->state, "baselines", false, with->err);
    if (status == FM_OK)
        status = baseline_find(with->baseline_path, store, name, with->now->manifest, with->err);
    if (status == FM_OK)
        return result_files_read(&with->baseline, with->baseline_path, with->err);
    if (status != FM_UNSUPPORTED)
        return status;
    fprintf(stderr, "fragmark night: %s\n", with->err->message);
    return text_list_add(&with->given->notes, with->err->message)
               ? FM_OK
               : fm_fail(with->err, FM_NO_MEMORY, "no memory for a note");
}

static fm_status record(session *with)
{
    fm_recorded recorded;
    fm_status status =
        history_open(&with->history, with->history_path, FM_HISTORY_WRITE, with->err);
    if (status == FM_OK)
        status = history_record(&recorded, with->history, with->now, with->err);
    return status == FM_UNSUPPORTED ? FM_INVALID : status;
}

static fm_status write_text(const session *with, const char *name, fm_text *text)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, with->given->output, name, with->err);
    if (status == FM_OK && text->failed)
        status = fm_fail(with->err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        status = text_write_file(path, text->bytes, text->length, with->err);
    text_free(text);
    return status;
}

static fm_status write_page(const session *with, const fm_night_result *night)
{
    char path[FM_PATH_MAX_BYTES];
    fm_run_list runs;
    fm_status status = history_runs(&runs, with->history, with->err);
    if (status == FM_OK)
        status = path_join(path, with->given->output, "history.html", with->err);
    if (status == FM_OK)
        status = history_page_write(
            path, &(fm_history_page_desc){ &night->series, &runs, with->given->reference },
            with->err);
    history_runs_free(&runs);
    return status;
}

/* night.json comes last: where it is, all is. */
static fm_status write_files(const session *with, const fm_night_result *night)
{
    fm_text markdown = { 0 }, junit = { 0 }, json = { 0 };
    fm_status status = path_make_folders(with->given->output, with->err);
    if (status != FM_OK)
        return status == FM_INVALID ? FM_IO : status;
    night_add_markdown(&markdown, night);
    night_add_junit(&junit, night);
    status = write_page(with, night);
    if (status == FM_OK)
        status = night_add_json(&json, night, with->err);
    if (status == FM_OK)
        status = write_text(with, "summary.md", &markdown);
    if (status == FM_OK)
        status = write_text(with, "junit.xml", &junit);
    if (status == FM_OK)
        status = write_text(with, "night.json", &json);
    text_free(&json);
    text_free(&junit);
    text_free(&markdown);
    return status;
}

static int judge(session *with)
{
    fm_night_result night = { 0 };
    const fm_night_desc desc = { .history = with->history,
                                 .now = with->now,
                                 .baseline = with->baseline,
                                 .baseline_name =
                                     with->baseline != NULL ? with->given->baseline : NULL,
                                 .reference = with->given->reference,
                                 .effect = with->given->effect,
                                 .confirm = with->given->gate != NULL ? gate_confirm : NULL,
                                 .context = &with->answers,
                                 .unconfirmed = with->given->unconfirmed,
                                 .notes = &with->given->notes };
    fm_status status = night_judge(&night, &desc, with->err);
    if (status == FM_OK)
        status = write_files(with, &night);
    int code = results_exit_code(status);
    if (status == FM_OK) {
        for (size_t i = 0; i < night.count; i++)
            printf("%s%s: %s: %s\n", finding_kind_name(night.findings[i].kind),
                   finding_standing(&night.findings[i]),
                   with->now->cases[night.findings[i].case_index].id, night.findings[i].text);
        printf("%s/summary.md\n", with->given->output);
        code = night.alarms > 0         ? FM_EXIT_CLAIM_FAILS
               : night.new_failures > 0 ? FM_EXIT_SOME_FAILED
                                        : FM_EXIT_DONE;
        fm_fail(with->err, FM_OK, "%s", code == FM_EXIT_CLAIM_FAILS ? "ALARM" : "cases failed");
    }
    night_free(&night);
    return code;
}

static int run(session *with)
{
    const night_arguments *given = with->given;
    if (results_folder_check(given->run, with->err) != FM_OK)
        return FM_EXIT_USAGE;
    fm_status status = result_files_read(&with->now, given->run, with->err);
    if (status != FM_OK)
        return status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_DAMAGED;
    for (size_t i = 0; i < with->now->missing.count; i++)
        if (!text_list_add(&with->given->notes, with->now->missing.items[i]))
            return FM_EXIT_INCOMPLETE;
    status = state_path(with->history_path, given->state, "history.sqlite", true, with->err);
    if (status != FM_OK)
        return status == FM_IO ? FM_EXIT_INCOMPLETE : FM_EXIT_USAGE;
    status = open_baseline(with);
    if (status == FM_OK && given->gate != NULL)
        status = gate_answers_open(&with->answers, given->gate, with->err);
    if (status == FM_OK)
        status = record(with);
    return status == FM_OK ? judge(with) : results_exit_code(status);
}

int night_main(int argc, char **argv)
{
    night_arguments given = { 0 };
    fm_error err = { 0 };
    session with = { .given = &given, .err = &err };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const int code = run(&with);
    gate_answers_close(&with.answers);
    history_close(with.history);
    result_files_close(with.baseline);
    result_files_close(with.now);
    text_list_free(&given.notes);
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark night: %s\n", err.message);
    return code;
}
