#include "history_command.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "base/state.h"
#include "history/record.h"
#include "history/runs.h"
#include "history/series.h"
#include "model/exit_code.h"
#include "page/history_page.h"
#include "print_text.h"
#include "results_folder.h"

typedef enum history_action {
    HISTORY_ADD,
    HISTORY_LIST,
    HISTORY_SHOW,
    HISTORY_PAGE
} history_action;

static const char *const action_names[] = {
    [HISTORY_ADD] = "add",
    [HISTORY_LIST] = "list",
    [HISTORY_SHOW] = "show",
    [HISTORY_PAGE] = "page",
};
enum { ACTIONS = sizeof action_names / sizeof action_names[0] };

typedef struct history_arguments {
    int action; /* -1: not given yet */
    fm_text_list names;
    fm_series_desc series;
    const char *state, *page;
    bool wants_json;
    char path[FM_PATH_MAX_BYTES]; /* of the database */
} history_arguments;

enum { KEY_JSON = 512, KEY_STATE, KEY_MACHINE, KEY_LEVEL, KEY_NIGHTS };

static void take_action(history_arguments *given, const char *word, struct argp_state *state)
{
    for (int i = 0; i < ACTIONS; i++)
        if (strcmp(word, action_names[i]) == 0)
            given->action = i;
    if (given->action >= 0)
        return;
    const char *nearest = text_nearest(word, action_names, ACTIONS);
    argp_error(state, "'%.40s': add, list, show or page%s%s%s", word,
               nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
               nearest != NULL ? "'" : "");
}

static void take_level(history_arguments *given, const char *text, struct argp_state *state)
{
    if (!text_to_double(&given->series.level, text) || given->series.level <= 0 ||
        given->series.level >= 1)
        argp_error(state, "--level %.40s: a chance between 0 and 1", text);
}

static void take_nights(history_arguments *given, const char *text, struct argp_state *state)
{
    uint64_t count;
    if (!text_to_u64(&count, text) || count == 0 || count > RANK_SUM_VALUES)
        argp_error(state, "--nights %.40s: a number from 1 to %d", text, RANK_SUM_VALUES);
    given->series.most = (size_t)count;
}

static void check(const history_arguments *given, struct argp_state *state)
{
    switch (given->action) {
    case HISTORY_ADD:
        if (given->names.count == 0)
            argp_error(state, "add which DIR? One that `fragmark run -o DIR` has written");
        break;
    case HISTORY_SHOW:
        if (given->names.count != 1)
            argp_error(state, "show which case or method? One name");
        break;
    case HISTORY_PAGE:
        if (given->page == NULL)
            argp_error(state, "page: -o FILE.html says where to");
        if (given->names.count > 1)
            argp_error(state, "page: one case or method, or none for all");
        break;
    case HISTORY_LIST:
        if (given->names.count > 0)
            argp_error(state, "list takes no name; '%s' is one: show it?", given->names.items[0]);
        break;
    default:
        argp_error(state, "what? add, list, show or page");
    }
}

static error_t parse(int key, char *value, struct argp_state *state)
{
    history_arguments *given = state->input;
    switch (key) {
    case 'r':
        given->series.reference = value;
        return 0;
    case 'o':
        given->page = value;
        return 0;
    case KEY_JSON:
        given->wants_json = true;
        return 0;
    case KEY_STATE:
        given->state = value;
        return 0;
    case KEY_MACHINE:
        given->series.machine = value;
        return 0;
    case KEY_LEVEL:
        take_level(given, value, state);
        return 0;
    case KEY_NIGHTS:
        take_nights(given, value, state);
        return 0;
    case ARGP_KEY_ARG:
        if (given->action < 0)
            take_action(given, value, state);
        else if (!text_list_add(&given->names, value))
            argp_failure(state, FM_EXIT_INCOMPLETE, 0, "no memory");
        return 0;
    case ARGP_KEY_END:
        check(given, state);
        return 0;
    default:
        return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option options[] = {
    { "state", KEY_STATE, "DIR", 0,
      "where the history is: DIR/history.sqlite; without it $XDG_STATE_HOME/fragmark, or "
      "~/.local/state/fragmark",
      0 },
    { "reference", 'r', "METHOD|floor", 0,
      "over what frame_ms is taken, within each run: a method on the same workload, launch by "
      "launch; floor is the default",
      0 },
    { "machine", KEY_MACHINE, "FINGERPRINT", 0, "show, page: of this machine alone", 0 },
    { "nights", KEY_NIGHTS, "N", 0, "show, page: the last N nights; 200, the most there can be",
      0 },
    { "level", KEY_LEVEL, "P", 0,
      "show, page: the chance of marking a step where there is none, of each case; 0.01", 0 },
    { "output", 'o', "FILE.html", 0, "page: where to", 0 },
    { "json", KEY_JSON, NULL, 0, "list, show: JSON instead of lines", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "add DIR...\nlist\nshow CASE|METHOD\npage -o FILE.html [CASE|METHOD]",
    .doc = "Keeps what runs of many nights measured, and shows since when something is slower.\v"
           "add records folders of results: run, machine, commit, code, and of each case its "
           "status, times, memory, errors and launches. A run that is added again replaces what "
           "it was: it stays one entry. Several processes may add at a time.\n\n"
           "show prints a case (its id, or its title in quotes), or all cases of a method, night "
           "by night; page draws all of them. Cases are found again by what they were asked for, "
           "as in `fragmark compare`, each machine and device on its own: milliseconds of two "
           "machines never meet. A machine's fingerprint stands for processor, cores and "
           "memory; list shows it.\n\n"
           "What is followed is the ratio of frame_ms to the floor, or to a method, of the same "
           "launch or round: the middle of a night's launches, without the outermost tenths. A "
           "step is where the exact rank-sum test parts the nights. An alarm is about the last "
           "nights alone, and rarely wrong: in a month without a step at most once in twenty "
           "such months, over all cases of the machine.\n\n"
           "Examples:\n"
           "  fragmark history add out/monday out/tuesday\n"
           "  fragmark history list\n"
           "  fragmark history show kplus-heap\n"
           "  fragmark history page -o history.html --reference ab-ll\n\n"
           "Exit codes: 0 done; 2 wrong use: no such folder, case, method or machine, or no "
           "history yet; 5 something cannot be written, or others kept the history locked; 8 a "
           "damaged or foreign history, one of a newer fragmark, or damaged results.",
};

static int code_of(fm_status status)
{
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

static int add_folder(fm_history *history, const char *directory, fm_error *err)
{
    fm_result_files *results;
    fm_recorded recorded;
    if (results_folder_check(directory, err) != FM_OK)
        return FM_EXIT_USAGE;
    fm_status status = result_files_read(&results, directory, err);
    if (status != FM_OK)
        return status == FM_NO_MEMORY ? FM_EXIT_INCOMPLETE : FM_EXIT_DAMAGED;
    for (size_t i = 0; i < results->missing.count; i++)
        fprintf(stderr, "fragmark history: %s: %s\n", directory, results->missing.items[i]);
    status = history_record(&recorded, history, results, err);
    if (status == FM_OK)
        printf("%s: %zu case%s, %s\n", directory, results->count, results->count == 1 ? "" : "s",
               recorded == FM_RECORDED_NEW ? "added" : "the run was there; replaced");
    result_files_close(results);
    return status == FM_UNSUPPORTED ? FM_EXIT_DAMAGED : code_of(status);
}

static int add(fm_history *history, const history_arguments *given, fm_error *err)
{
    int code = FM_EXIT_DONE;
    for (size_t i = 0; i < given->names.count && code == FM_EXIT_DONE; i++)
        code = add_folder(history, given->names.items[i], err);
    return code;
}

static fm_status list(fm_history *history, const history_arguments *given, fm_error *err)
{
    fm_text text = { 0 };
    fm_run_list runs;
    fm_status status = history_runs(&runs, history, err);
    if (status == FM_OK && given->wants_json)
        status = history_add_runs_json(&text, &runs, err);
    else if (status == FM_OK)
        history_add_runs(&text, &runs);
    history_runs_free(&runs);
    return print_text(&text, status, err);
}

static fm_status show(fm_history *history, const history_arguments *given, fm_error *err)
{
    fm_text text = { 0 };
    fm_series_list series;
    fm_status status = history_series(&series, history, &given->series, err);
    if (status == FM_OK && given->wants_json)
        status = history_add_series_json(&text, &series, given->series.reference, err);
    else if (status == FM_OK)
        history_add_series(&text, &series, given->series.reference);
    history_series_free(&series);
    return print_text(&text, status, err);
}

static fm_status page(fm_history *history, const history_arguments *given, fm_error *err)
{
    fm_series_list series;
    fm_run_list runs = { 0 };
    fm_status status = history_series(&series, history, &given->series, err);
    if (status == FM_OK)
        status = history_runs(&runs, history, err);
    if (status == FM_OK)
        status = history_page_write(
            given->page, &(fm_history_page_desc){ &series, &runs, given->series.reference }, err);
    if (status == FM_OK)
        printf("%s\n", given->page);
    history_runs_free(&runs);
    history_series_free(&series);
    return status;
}

static int act(history_arguments *given, fm_error *err)
{
    fm_history *history = NULL;
    const bool is_written = given->action == HISTORY_ADD;
    int code;
    fm_status status = state_path(given->path, given->state, "history.sqlite", is_written, err);
    if (status != FM_OK)
        return status == FM_IO ? FM_EXIT_INCOMPLETE : FM_EXIT_USAGE;
    status =
        history_open(&history, given->path, is_written ? FM_HISTORY_WRITE : FM_HISTORY_READ, err);
    if (status != FM_OK)
        return code_of(status);
    if (given->names.count > 0 && given->action != HISTORY_ADD)
        given->series.wanted = given->names.items[0];
    if (given->action == HISTORY_ADD)
        code = add(history, given, err);
    else if (given->action == HISTORY_LIST)
        code = code_of(list(history, given, err));
    else if (given->action == HISTORY_SHOW)
        code = code_of(show(history, given, err));
    else
        code = code_of(page(history, given, err));
    history_close(history);
    return code;
}

int history_main(int argc, char **argv)
{
    history_arguments given = { .action = -1 };
    fm_error err = { 0 };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const int code = act(&given, &err);
    text_list_free(&given.names);
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark history: %s\n", err.message);
    return code;
}
