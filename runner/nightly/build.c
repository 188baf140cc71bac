#include "build.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "child/child.h"

enum { LOG_LINES = 20, LOG_BYTES = 64 << 20 };
static const double share_of_budget = 0.5;

static fm_status no_command(const fm_policy *policy, const char *where, fm_error *err)
{
    return fm_fail(err, FM_INVALID, "build: '%.200s' is no program %s", policy->build.items[0],
                   where);
}

fm_status build_find_command(char path[FM_PATH_MAX_BYTES], const fm_policy *policy, fm_error *err)
{
    char joined[FM_PATH_MAX_BYTES];
    const char *name = policy->build.items[0];
    if (strchr(name, '/') == NULL) {
        const fm_status status = child_find(path, FM_PATH_MAX_BYTES, name, name, NULL);
        return status == FM_OK ? FM_OK : no_command(policy, "in PATH", err);
    }
    fm_status status = name[0] == '/' ? path_join(joined, "", name + 1, err)
                                      : path_join(joined, policy->folder, name, err);
    if (status != FM_OK)
        return status;
    char *whole = realpath(joined, NULL); /* it works in another folder */
    if (whole == NULL || access(whole, X_OK) != 0 || path_is_folder(whole, NULL) == FM_OK ||
        strlen(whole) >= FM_PATH_MAX_BYTES)
        status = no_command(policy, "that can be executed", err);
    else
        strcpy(path, whole);
    free(whole);
    return status;
}

static void add_command(fm_text *text, const fm_policy *policy)
{
    for (size_t i = 0; i < policy->build.count; i++) {
        text_add(text, "%s", i > 0 ? " " : "");
        cli_add_word(text, policy->build.items[i]);
    }
}

void build_add_note(fm_text *note, const fm_tonight *tonight)
{
    text_add(note, "Built in %.0f s by `", tonight->night.built_s);
    add_command(note, tonight->policy);
    text_add(note, "`.");
}

/* The end of build.log, indented: code for Markdown, whatever is in it. */
static void add_log(fm_text *text, const char *folder)
{
    char path[FM_PATH_MAX_BYTES], *bytes = NULL;
    size_t count = 0, lines = 0;
    if (path_join(path, folder, "build.log", NULL) != FM_OK ||
        text_read_file(&bytes, &count, path, LOG_BYTES, NULL) != FM_OK)
        return;
    text_make_utf8(bytes);
    char *line = bytes + strlen(bytes);
    while (line > bytes && lines < LOG_LINES + 1)
        lines += *--line == '\n';
    char *rest = line + (*line == '\n');
    for (char *item; (item = strsep(&rest, "\n")) != NULL;)
        text_add(text, "    %s\n", item);
    free(bytes);
}

/* What a reader of the night finds who looks for its results. */
static fm_status write_summary(const fm_night_state *night, const char *why, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_text text = { 0 };
    text_add(&text,
             "# fragmark nightly: not built\n\n%s Nothing was measured. build.log ends with:\n\n",
             why);
    add_log(&text, night->folder);
    fm_status status = path_join(path, night->folder, "summary.md", err);
    if (status == FM_OK && text.failed)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        status = text_write_file(path, text.bytes, text.length, err);
    text_free(&text);
    return status;
}

static fm_status give_up(fm_tonight *tonight, const fm_night_end *end, double most_s, fm_error *err)
{
    fm_text why = { 0 };
    fm_night_state *night = &tonight->night;
    text_add(&why, "`");
    add_command(&why, tonight->policy);
    if (end->is_cut_off)
        text_add(&why, "` did not end within %.0f s, which is half of the budget.", most_s);
    else
        text_add(&why, "` ended with %d after %.0f s.", end->code, end->seconds);
    const char *told = why.bytes != NULL ? why.bytes : "";
    fprintf(tonight->cli->talk,
            "fragmark nightly: not built, and nothing measured: %s See %s/build.log\n", told,
            night->folder);
    night->stage = FM_NIGHT_GIVEN_UP;
    const fm_status status = write_summary(night, told, err);
    text_free(&why);
    return status;
}

fm_status stage_build(fm_tonight *tonight, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_night_end end;
    fm_night_state *night = &tonight->night;
    const fm_policy *policy = tonight->policy;
    const double most_s = share_of_budget * policy_seconds(policy, 0.0);
    const fm_night_program program = {
        .path = path, .folder = policy->folder, .log = "build.log", .seconds = most_s
    };
    fm_status status = build_find_command(path, policy, err);
    if (status == FM_OK)
        status = tonight_execute(&end, tonight, &policy->build, &program, err);
    if (status != FM_OK)
        return status;
    night->built_s += end.seconds;
    if (end.is_cut_off || end.code != 0)
        status = give_up(tonight, &end, most_s, err);
    else
        night->stage = FM_NIGHT_PLANS;
    return status == FM_OK ? night_state_write(night, err) : status;
}
