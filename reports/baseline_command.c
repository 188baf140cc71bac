#include "baseline_command.h"

#include <argp.h>
#include <stdio.h>
#include <string.h>

#include "base/state.h"
#include "baseline/baseline.h"
#include "model/exit_code.h"
#include "results_folder.h"

typedef struct baseline_arguments {
    const char *words[3]; /* set NAME DIR, list, show [NAME] */
    int word_count;
    const char *state;
    bool wants_json;
} baseline_arguments;

enum { KEY_JSON = 512, KEY_STATE };

static void check(baseline_arguments *given, struct argp_state *state)
{
    static const char *const names[] = { "set", "list", "show" };
    const char *action = given->word_count > 0 ? given->words[0] : "";
    if (strcmp(action, "set") == 0) {
        if (given->word_count != 3)
            argp_error(state, "set NAME DIR: a name, and a folder that `fragmark run -o DIR` has "
                              "written");
    } else if (strcmp(action, "list") == 0) {
        if (given->word_count > 1)
            argp_error(state, "list takes no name; '%s' is one: show it?", given->words[1]);
    } else if (strcmp(action, "show") == 0) {
        if (given->word_count > 2)
            argp_error(state, "show one NAME, or all; '%s' is a second one", given->words[2]);
    } else {
        const char *nearest = text_nearest(action, names, 3);
        argp_error(state, "'%.40s': set, list or show%s%s%s", action,
                   nearest != NULL ? "; the nearest is '" : "", nearest != NULL ? nearest : "",
                   nearest != NULL ? "'" : "");
    }
}

static error_t parse(int key, char *value, struct argp_state *state)
{
    baseline_arguments *given = state->input;
    switch (key) {
    case KEY_STATE:
        given->state = value;
        return 0;
    case KEY_JSON:
        given->wants_json = true;
        return 0;
    case ARGP_KEY_ARG:
        if (given->word_count == 3)
            argp_error(state, "set NAME DIR, list, or show [NAME]; '%s' is too much", value);
        given->words[given->word_count++] = value;
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
      "where baselines are: DIR/baselines; without it $XDG_STATE_HOME/fragmark, or "
      "~/.local/state/fragmark",
      0 },
    { "json", KEY_JSON, NULL, 0, "list, show: JSON instead of lines", 0 },
    { 0 },
};
static const struct argp argp = {
    .options = options,
    .parser = parse,
    .args_doc = "set NAME DIR\nlist\nshow [NAME]",
    .doc = "Names a run, so that later ones are held against it.\v"
           "set copies the result files of DIR, so that the baseline stays when the folder goes. "
           "A name has one run of each machine (processor, cores, memory); setting it again "
           "replaces that of the same machine. show says where they are, and whether their files "
           "are those that were copied.\n\n"
           "`fragmark compare baseline:NAME NEW` takes that of NEW's machine, and "
           "baseline:NAME@FINGERPRINT the one of another, by ratios. `fragmark nightly` takes the "
           "one that its policy names.\n\n"
           "Examples:\n"
           "  fragmark baseline set release-1 out/release-1\n"
           "  fragmark baseline list\n"
           "  fragmark compare baseline:release-1 out/mine\n\n"
           "Exit codes: 0 done; 2 wrong use, a folder without results, or no such baseline; 5 "
           "something cannot be written; 8 damaged or foreign results, or a baseline that was "
           "changed.",
};

static int set(const char *store, const char *name, const char *directory, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_result_files *results;
    if (results_folder_check(directory, err) != FM_OK)
        return FM_EXIT_USAGE;
    fm_status status = result_files_read(&results, directory, err);
    if (status == FM_OK)
        status = baseline_set(path, store, name, results, err);
    else if (status == FM_IO)
        status = FM_INVALID; /* a file is gone */
    if (status == FM_OK)
        printf("%s\n", path);
    result_files_close(results);
    return results_exit_code(status);
}

static fm_status add_checks(fm_text *text, const fm_baseline_list *list, fm_error *err)
{
    for (size_t i = 0; i < list->count; i++) {
        const fm_status status = baseline_check(&list->items[i], err);
        if (status != FM_OK)
            return status;
        text_add(text, "%s: unchanged since %s\n", list->items[i].path,
                 baseline_fact(&list->items[i], "set"));
    }
    return FM_OK;
}

/* list, and show, which needs the name to be there and checks the files. */
static int print(const char *store, const baseline_arguments *given, fm_error *err)
{
    fm_text text = { 0 };
    fm_baseline_list list;
    const char *name = given->word_count > 1 ? given->words[1] : NULL;
    fm_status status = baselines_read(&list, store, name, err);
    if (status == FM_OK && name != NULL && list.count == 0)
        status = fm_fail(err, FM_UNSUPPORTED, "no baseline '%.80s' in %s: `fragmark baseline list`",
                         name, store);
    if (status == FM_OK && given->wants_json)
        status = baselines_add_json(&text, &list, err);
    else if (status == FM_OK)
        baselines_add_lines(&text, &list);
    if (status == FM_OK && strcmp(given->words[0], "show") == 0 && !given->wants_json)
        status = add_checks(&text, &list, err);
    if (status == FM_OK && text.failed)
        status = fm_fail(err, FM_NO_MEMORY, "no memory for %zu baselines", list.count);
    if (text.length > 0 && !text.failed)
        fwrite(text.bytes, 1, text.length, stdout);
    if (status == FM_OK && (fflush(stdout) != 0 || ferror(stdout)))
        status = fm_fail(err, FM_IO, "what it printed could not be written");
    text_free(&text);
    baselines_free(&list);
    return results_exit_code(status);
}

int baseline_main(int argc, char **argv)
{
    char store[FM_PATH_MAX_BYTES];
    baseline_arguments given = { 0 };
    fm_error err = { 0 };
    argp_err_exit_status = FM_EXIT_USAGE;
    argp_parse(&argp, argc, argv, 0, NULL, &given);
    const bool is_set = strcmp(given.words[0], "set") == 0;
    int code = FM_EXIT_USAGE;
    if (state_path(store, given.state, "baselines", is_set, &err) == FM_OK)
        code =
            is_set ? set(store, given.words[1], given.words[2], &err) : print(store, &given, &err);
    if (code != FM_EXIT_DONE)
        fprintf(stderr, "fragmark baseline: %s\n", err.message);
    return code;
}
