#include "state.h"

#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <jansson.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

enum { STATE_BYTES = 1 << 20, JUDGED_BYTES = 64 << 20 };

static const char *const stage_names[] = {
    [FM_NIGHT_BUILDS] = "builds",     [FM_NIGHT_PLANS] = "plans",
    [FM_NIGHT_MEASURES] = "measures", [FM_NIGHT_JUDGES] = "judges",
    [FM_NIGHT_CONFIRMS] = "confirms", [FM_NIGHT_DONE] = "done",
    [FM_NIGHT_GIVEN_UP] = "given-up",
};
_Static_assert(sizeof stage_names / sizeof stage_names[0] == FM_NIGHT_STAGES, "one name a stage");

static const char *const gate_names[] = {
    [FM_NIGHT_GATE_NONE] = "none",
    [FM_NIGHT_GATE_ANSWERED] = "answered",
    [FM_NIGHT_GATE_NO_TIME] = "no-time",
    [FM_NIGHT_GATE_FAILED] = "failed",
};
_Static_assert(sizeof gate_names / sizeof gate_names[0] == FM_NIGHT_GATES, "one name a state");

/* Of building and confirming: nights of before have none of these. */
static bool add_rest(json_t *json, const fm_night_state *state)
{
    json_t *rest = json_pack("{s:f, s:s, s:f, s:I}", "built_s", state->built_s, "gate",
                             gate_names[state->gate], "confirmed_s", state->confirmed_s,
                             "gate_attempt_s", (json_int_t)state->gate_attempt_s);
    const bool is_added = rest != NULL && json_object_update(json, rest) == 0;
    json_decref(rest);
    return is_added;
}

static bool take_rest(fm_night_state *state, json_t *json)
{
    const char *gate = gate_names[FM_NIGHT_GATE_NONE];
    json_int_t attempt_s = 0;
    bool is_known = false;
    if (json_unpack(json, "{s?F, s?s, s?F, s?I}", "built_s", &state->built_s, "gate", &gate,
                    "confirmed_s", &state->confirmed_s, "gate_attempt_s", &attempt_s) != 0)
        return false;
    for (int i = 0; i < FM_NIGHT_GATES; i++)
        if (strcmp(gate, gate_names[i]) == 0) {
            state->gate = (fm_night_gate)i;
            is_known = true;
        }
    state->gate_attempt_s = attempt_s;
    return is_known && state->built_s >= 0 && state->confirmed_s >= 0;
}

static json_t *to_json(const fm_night_state *state)
{
    json_t *methods = json_array();
    for (size_t i = 0; i < state->methods.count; i++)
        json_array_append_new(methods, json_string(state->methods.items[i]));
    return json_pack("{s:i, s:s, s:s, s:I, s:I, s:I, s:I, s:I, s:o, s:f, s:I, s:b, s:i}", "schema",
                     1, "stage", stage_names[state->stage], "policy", state->policy, "begun_s",
                     (json_int_t)state->begun_s, "launches", (json_int_t)state->launches, "cases",
                     (json_int_t)state->cases, "part", (json_int_t)state->part, "parts",
                     (json_int_t)state->parts, "methods", methods, "measured_s", state->measured_s,
                     "attempt_s", (json_int_t)state->attempt_s, "is_cut_off", state->is_cut_off,
                     "code", state->code);
}

fm_status night_state_write(const fm_night_state *state, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    json_t *json = to_json(state);
    char *text = json != NULL && add_rest(json, state) ? json_dumps(json, JSON_INDENT(2)) : NULL;
    json_decref(json);
    if (text == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: no memory", state->folder);
    fm_status status = path_join(path, state->folder, "nightly.json", err);
    if (status == FM_OK)
        status = text_write_file(path, text, strlen(text), err);
    free(text);
    return status;
}

static fm_status load(json_t **json, const char *folder, const char *name, size_t most,
                      fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], *bytes = NULL;
    size_t count = 0;
    json_error_t where;
    *json = NULL;
    fm_status status = path_join(path, folder, name, err);
    if (status == FM_OK)
        status = text_read_file(&bytes, &count, path, most, err);
    if (status != FM_OK)
        return status;
    *json = json_loadb(bytes, count, 0, &where);
    free(bytes);
    return *json != NULL ? FM_OK
                         : fm_fail(err, FM_INVALID, "%s:%d: %s", path, where.line, where.text);
}

static bool take_stage(fm_night_state *state, const char *name)
{
    for (int i = 0; i < FM_NIGHT_STAGES && name != NULL; i++)
        if (strcmp(name, stage_names[i]) == 0) {
            state->stage = (fm_night_stage)i;
            return true;
        }
    return false;
}

static bool take_methods(fm_night_state *state, const json_t *methods)
{
    bool is_taken = true;
    for (size_t i = 0; i < json_array_size(methods); i++) {
        const char *name = json_string_value(json_array_get(methods, i));
        is_taken = is_taken && name != NULL && text_list_add(&state->methods, name);
    }
    return is_taken;
}

static bool take_fields(fm_night_state *state, json_t *json)
{
    const char *stage = NULL, *policy = NULL;
    const json_t *methods = NULL;
    int schema = 0, is_cut_off = 0;
    json_int_t begun_s = 0, launches = 0, cases = 0, part = 0, parts = 0, attempt_s = 0;
    if (json_unpack(json, "{s:i, s:s, s:s, s:I, s:I, s?I, s:I, s:I, s:o, s:F, s:I, s:b, s:i}",
                    "schema", &schema, "stage", &stage, "policy", &policy, "begun_s", &begun_s,
                    "launches", &launches, "cases", &cases, "part", &part, "parts", &parts,
                    "methods", &methods, "measured_s", &state->measured_s, "attempt_s", &attempt_s,
                    "is_cut_off", &is_cut_off, "code", &state->code) != 0 ||
        schema != 1 || !take_stage(state, stage) || strlen(policy) >= sizeof state->policy ||
        launches < 1 || launches > UINT32_MAX || cases < 0 || cases > UINT32_MAX || parts < 1 ||
        parts > UINT32_MAX || part < 0 || part >= parts || !(state->measured_s >= 0))
        return false;
    strcpy(state->policy, policy);
    state->begun_s = begun_s;
    state->launches = (uint32_t)launches;
    state->cases = (uint32_t)cases;
    state->part = (uint32_t)part;
    state->parts = (uint32_t)parts;
    state->attempt_s = attempt_s;
    state->is_cut_off = is_cut_off != 0;
    return take_methods(state, methods);
}

fm_status night_state_read(fm_night_state *state, const char *folder, fm_error *err)
{
    json_t *json;
    *state = (fm_night_state){ 0 };
    fm_status status = load(&json, folder, "nightly.json", STATE_BYTES, err);
    if (status == FM_OK && !(take_fields(state, json) && take_rest(state, json)))
        status =
            fm_fail(err, FM_INVALID, "%s/nightly.json: damaged, or of another fragmark", folder);
    snprintf(state->folder, sizeof state->folder, "%s", folder);
    json_decref(json);
    return status;
}

void night_state_free(fm_night_state *state)
{
    text_list_free(&state->methods);
}

bool night_is_open(const fm_night_state *state)
{
    return state->stage != FM_NIGHT_DONE && state->stage != FM_NIGHT_GIVEN_UP;
}

/* 20260131T010000Z */
static int is_night(const struct dirent *entry)
{
    static const char form[] = "ddddddddTddddddZ";
    const char *name = entry->d_name;
    size_t i = 0;
    while (form[i] != '\0' &&
           (form[i] == 'd' ? isdigit((unsigned char)name[i]) != 0 : form[i] == name[i]))
        i++;
    return form[i] == '\0' && name[i] == '\0';
}

fm_status nights_list(fm_text_list *names, const char *root, fm_error *err)
{
    struct dirent **entries = NULL;
    bool has_memory = true;
    const int count = scandir(root, &entries, is_night, alphasort);
    if (count < 0)
        return errno == ENOENT ? FM_OK : fm_fail(err, FM_IO, "%s: %s", root, strerror(errno));
    for (int i = 0; i < count; i++) {
        has_memory = has_memory && text_list_add(names, entries[i]->d_name);
        free(entries[i]);
    }
    free(entries);
    return has_memory ? FM_OK : fm_fail(err, FM_NO_MEMORY, "%s: no memory", root);
}

static uint32_t read_needed(const char *folder)
{
    json_t *json;
    json_int_t needed = 0;
    if (load(&json, folder, "night.json", JUDGED_BYTES, NULL) != FM_OK)
        return 0;
    needed = json_integer_value(json_object_get(json, "launches_needed"));
    json_decref(json);
    return needed > 0 && needed < UINT32_MAX ? (uint32_t)needed : 0;
}

uint64_t night_launches_ended(const fm_night_state *state)
{
    char path[FM_PATH_MAX_BYTES], *line = NULL;
    size_t room = 0;
    uint64_t ended = 0;
    FILE *journal = path_join(path, state->folder, "run/journal.jsonl", NULL) == FM_OK
                        ? fopen(path, "re")
                        : NULL;
    while (journal != NULL && getline(&line, &room, journal) > 0)
        ended += strstr(line, "\"event\":\"end\"") != NULL;
    free(line);
    if (journal != NULL)
        fclose(journal);
    return ended;
}

/* Rounds that were measured, the last one maybe in part; 0: not known. */
static double rounds_of(const fm_night_state *state)
{
    if (!state->is_cut_off)
        return state->launches;
    return state->cases > 0 ? (double)night_launches_ended(state) / state->cases : 0.0;
}

static void take_past(fm_night_past *past, const fm_night_state *state, const char *policy)
{
    if (state->stage != FM_NIGHT_DONE || strcmp(state->policy, policy) != 0)
        return;
    past->nights++;
    past->parts = state->parts;
    past->launches_needed = read_needed(state->folder);
    const double rounds = rounds_of(state);
    past->seconds_per_round = rounds > 0.0 ? state->measured_s / rounds : 0.0;
}

fm_status night_past(fm_night_past *past, const char *root, const char *policy, fm_error *err)
{
    fm_text_list names = { 0 };
    *past = (fm_night_past){ 0 };
    fm_status status = nights_list(&names, root, err);
    for (size_t i = 0; i < names.count && status == FM_OK; i++) {
        char folder[FM_PATH_MAX_BYTES];
        fm_night_state state = { 0 };
        status = path_join(folder, root, names.items[i], err);
        if (status == FM_OK && night_state_read(&state, folder, NULL) == FM_OK)
            take_past(past, &state, policy);
        night_state_free(&state);
    }
    text_list_free(&names);
    return status;
}

/* Of an attempt that was killed: up to the last line of its journal. */
static double killed_s(const fm_night_state *state, int64_t attempt_s, const char *journal)
{
    char path[FM_PATH_MAX_BYTES];
    struct stat info;
    if (attempt_s == 0 || path_join(path, state->folder, journal, NULL) != FM_OK ||
        stat(path, &info) != 0 || info.st_mtime < attempt_s)
        return 0.0;
    return (double)(info.st_mtime - attempt_s);
}

double night_measured_s(const fm_night_state *state)
{
    return state->measured_s + killed_s(state, state->attempt_s, "run/journal.jsonl");
}

double night_confirmed_s(const fm_night_state *state)
{
    return state->confirmed_s + killed_s(state, state->gate_attempt_s, "gate/new/journal.jsonl");
}
