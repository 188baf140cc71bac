/* Rows of an earlier run against the code that is here now. */
#include <limits.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "code/code_json.h"
#include "code/code_now.h"
#include "results/answer_check.h"
#include "run_internal.h"

enum { NO_CODE = 1u << FM_CODE_PART_COUNT }; /* beside the bits of parts: nobody wrote it down */

/* Rows of one method that changed. */
typedef struct method_change {
    const char *method;
    uint32_t rows, changes;
    fm_text_list files;
} method_change;

/* All of them; of_case tells which rows. */
typedef struct change_list {
    method_change *methods; /* [count] */
    size_t count;
    bool *of_case; /* [plan->count] */
} change_list;

static fm_status no_memory(fm_error *err)
{
    return fm_fail(err, FM_NO_MEMORY, "no memory for the codes of rows");
}

/* Where a launch stands, as far as the journal was heard. */
typedef enum launch_place { NOT_BEGUN, BEGUN, ENDED } launch_place;

typedef struct hearing {
    run_state *run;
    unsigned char *places; /* [plan->count][plan->launches], of launch_place */
} hearing;

static fm_status hear_order(const hearing *all, size_t row, uint32_t launch, fm_journal_event event,
                            fm_error *err)
{
    const size_t launches = all->run->plan->launches;
    unsigned char *place = &all->places[row * launches + launch];
    const char *wrong = NULL;
    switch (event) {
    case FM_JOURNAL_BEGIN:
        wrong = *place == ENDED ? "begins after its end" : NULL;
        *place = BEGUN;
        break;
    case FM_JOURNAL_END: /* without a beginning where no truth could be had */
        wrong = *place == ENDED ? "ended twice" : NULL;
        *place = ENDED;
        break;
    case FM_JOURNAL_DIED:
        wrong = *place != BEGUN ? "dies and had not begun" : NULL;
        break;
    case FM_JOURNAL_STOP:
        wrong = *place != BEGUN ? "stops and had not begun" : NULL;
        *place = NOT_BEGUN;
        break;
    case FM_JOURNAL_MORE: /* replayed together with the case's group */
    case FM_JOURNAL_ENOUGH:
        wrong = *place != NOT_BEGUN ? "is decided on and had begun" : NULL;
        break;
    case FM_JOURNAL_FORGET:
        memset(&all->places[row * launches], NOT_BEGUN, launches);
        break;
    case FM_JOURNAL_EVENT_COUNT:
        break;
    }
    return wrong == NULL ? FM_OK : fm_fail(err, FM_INVALID, "launch %u %s", launch, wrong);
}

static fm_status hear(void *context, fm_journal_event event, const char *case_id, uint32_t launch,
                      const json_t *result, fm_error *err)
{
    const hearing *all = context;
    run_state *run = all->run;
    fm_code code;
    size_t row;
    fm_status status = run_find_case(&row, run, case_id, launch, err);
    if (status == FM_OK)
        status = hear_order(all, row, launch, event, err);
    if (status != FM_OK)
        return status;
    if (event == FM_JOURNAL_FORGET)
        codes_forget(&run->codes, row);
    if (result == NULL)
        return FM_OK;
    /* Nobody keeps a journal from being edited: an answer in it is held to what a worker's is. */
    status = answer_check(result, run_frames(run, &run->plan->cases[row].settings), err);
    if (status != FM_OK)
        return status;
    /* The end of a launch, or a death, which is told of and counts at the next one. */
    const bool has_code = answer_code(&code, result);
    status = codes_add(&run->codes, row, has_code ? &code : NULL, err);
    code_free(&code);
    return status;
}

static void note_driver(run_state *run, const char *device, uint64_t driver)
{
    if (driver != 0)
        json_object_set_new(run->drivers, device, json_integer((json_int_t)driver));
}

static fm_status take_driver(run_state *run, const fm_case *planned, const json_t *answer,
                             fm_error *err)
{
    fm_code code;
    const bool has_code = answer_code(&code, answer);
    fm_status status = FM_OK;
    if (answer_status(answer) != FM_CASE_OK)
        status = fm_fail(err, FM_IO,
                         "%s: rows were measured on it, and it cannot be opened: %s; the same "
                         "command continues where it can",
                         planned->device, answer_message(answer));
    else if (has_code)
        note_driver(run, planned->device, code.driver);
    code_free(&code);
    return status;
}

/* Asks a worker to open the case's device, once a device. */
static fm_status look_at_driver(run_state *run, size_t case_index, fm_error *err)
{
    char name[48];
    fm_launch_outcome outcome;
    const fm_case *planned = &run->plan->cases[case_index];
    if (run_known_driver(run, planned->device) != 0 || run->stop_signal != 0)
        return FM_OK;
    fm_request request = run_request_for(run, planned, run->truths.of_case[case_index], "");
    request.is_device_job = true;
    snprintf(name, sizeof name, "device-%zu", case_index);
    const run_attempt attempt = {
        .name = name, .current = planned->device, .request = &request, .case_index = RUN_NO_CASE
    };
    char *death = NULL;
    fm_status status = run_attempt_launch(&outcome, run, &attempt, &death, err);
    free(death);
    if (status != FM_OK || outcome.kind == FM_LAUNCH_INTERRUPTED)
        return status;
    status = take_driver(run, planned, outcome.result, err);
    json_decref(outcome.result);
    return status;
}

/* What of the row's code is another one now. */
static fm_status compare_row(uint32_t *changes, fm_text_list *files, run_state *run,
                             size_t case_index, const fm_code *then, fm_error *err)
{
    fm_status status = FM_OK;
    fm_code now = { 0 };
    if (code_has_driver(then))
        status = look_at_driver(run, case_index, err);
    const fm_code_places places = run_code_places(run, case_index);
    code_look_again(&now, then, &places);
    *changes = code_changes(files, then, &now);
    if (status == FM_OK && now.failed)
        status = no_memory(err);
    code_free(&now);
    return status;
}

static method_change *change_of(change_list *list, const char *method)
{
    for (size_t i = 0; i < list->count; i++)
        if (strcmp(list->methods[i].method, method) == 0)
            return &list->methods[i];
    method_change *grown = reallocarray(list->methods, list->count + 1, sizeof *grown);
    if (grown == NULL)
        return NULL;
    list->methods = grown;
    grown[list->count] = (method_change){ .method = method };
    return &grown[list->count++];
}

static fm_status add_change(change_list *list, run_state *run, size_t case_index, uint32_t changes,
                            const fm_text_list *files, fm_error *err)
{
    if (changes == 0)
        return FM_OK;
    method_change *change = change_of(list, run->plan->cases[case_index].method);
    if (change == NULL)
        return no_memory(err);
    change->rows++;
    change->changes |= changes;
    list->of_case[case_index] = true;
    for (size_t i = 0; i < files->count; i++)
        if (!text_list_has(&change->files, files->items[i]) &&
            !text_list_add(&change->files, files->items[i]))
            return no_memory(err);
    return FM_OK;
}

/* Rows of one code, method and device are compared once. */
static bool is_as_before(const run_state *run, size_t a, size_t b)
{
    const fm_case *one = &run->plan->cases[a], *other = &run->plan->cases[b];
    return run->codes.rows[a].index == run->codes.rows[b].index &&
           strcmp(one->method, other->method) == 0 && strcmp(one->device, other->device) == 0 &&
           strcmp(one->feed, other->feed) == 0;
}

typedef struct compared_row {
    size_t case_index;
    uint32_t changes;
    fm_text_list files;
} compared_row;

static fm_status compare_rows(change_list *list, run_state *run, fm_error *err)
{
    fm_status status = FM_OK;
    size_t count = 0;
    compared_row *seen = calloc(run->plan->count + 1, sizeof *seen);
    if (seen == NULL)
        return no_memory(err);
    for (size_t i = 0; i < run->plan->count && status == FM_OK && run->stop_signal == 0; i++) {
        const fm_code *then = codes_of(&run->codes, i);
        size_t at = count;
        if (run->codes.rows[i].launches == 0)
            continue;
        while (at > 0 && !is_as_before(run, i, seen[at - 1].case_index))
            at--;
        if (at == 0) {
            at = ++count;
            seen[at - 1].case_index = i;
            if (then != NULL)
                status = compare_row(&seen[at - 1].changes, &seen[at - 1].files, run, i, then, err);
        }
        const uint32_t lacks = run->codes.rows[i].lacks_code ? NO_CODE : 0;
        if (status == FM_OK)
            status =
                add_change(list, run, i, seen[at - 1].changes | lacks, &seen[at - 1].files, err);
    }
    for (size_t i = 0; i < count; i++)
        text_list_free(&seen[i].files);
    free(seen);
    return status;
}

/* "the program; plugin, shaders: kb.so, store.glsl" */
static void say_what(fm_text *text, uint32_t changes, const fm_text_list *files)
{
    const char *between = "";
    if ((changes & NO_CODE) != 0) {
        text_add(text, "recorded before codes were kept");
        between = ", ";
    }
    for (int part = 0; part < FM_CODE_PART_COUNT; part++) {
        if ((changes & 1u << part) == 0)
            continue;
        text_add(text, "%s%s", between, code_part_name((fm_code_part)part));
        between = ", ";
    }
    for (size_t i = 0; i < files->count; i++)
        text_add(text, "%s%s", i == 0 ? ": " : ", ", files->items[i]);
}

/* Methods that changed alike are told together. */
static void say_changes(fm_text *text, const change_list *list)
{
    bool *is_told = calloc(list->count + 1, sizeof *is_told);
    for (size_t i = 0; is_told != NULL && i < list->count; i++) {
        fm_text what = { 0 }, who = { 0 };
        uint32_t rows = 0;
        if (is_told[i])
            continue;
        say_what(&what, list->methods[i].changes, &list->methods[i].files);
        for (size_t j = i; j < list->count; j++) {
            fm_text other = { 0 };
            say_what(&other, list->methods[j].changes, &list->methods[j].files);
            if (!other.failed && !what.failed && strcmp(what.bytes, other.bytes) == 0) {
                is_told[j] = true;
                rows += list->methods[j].rows;
                text_add(&who, "%s%s", who.length > 0 ? ", " : "", list->methods[j].method);
            }
            text_free(&other);
        }
        text_add(text, "%s%u %s of %s (%s)", text->length > 0 ? "; " : "", rows,
                 rows == 1 ? "row" : "rows", who.bytes != NULL ? who.bytes : "",
                 what.bytes != NULL ? what.bytes : "");
        text_free(&what);
        text_free(&who);
    }
    free(is_told);
}

static fm_status forget_rows(run_state *run, const change_list *list, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < run->plan->count && status == FM_OK; i++) {
        if (!list->of_case[i])
            continue;
        status = run_forget(run, i, err);
        codes_forget(&run->codes, i);
    }
    return status;
}

static fm_status settle(run_state *run, const change_list *list, fm_error *err)
{
    fm_text told = { 0 };
    fm_status status = FM_OK;
    if (list->count == 0)
        return FM_OK;
    say_changes(&told, list);
    const char *what = told.bytes != NULL ? told.bytes : "";
    if (run->desc->is_fresh) {
        progress_tell_always(&run->progress, "other code, measured anew", what);
        status = forget_rows(run, list, err);
    } else {
        run->is_other_code = true;
        status = fm_fail(err, FM_INVALID,
                         "%s: other code than its rows were measured by: %.1500s. Nothing was "
                         "launched, and its files are as they were; --fresh measures these rows "
                         "anew, another -o leaves them",
                         run->desc->directory, what);
    }
    text_free(&told);
    return status;
}

fm_status run_read_codes(run_state *run, fm_error *err)
{
    hearing all = { .run = run, .places = calloc(run->plan->count + 1, run->plan->launches) };
    const fm_journal_reader reader = { .line = hear, .context = &all };
    codes_free(&run->codes);
    fm_status status =
        all.places != NULL ? codes_create(&run->codes, run->plan->count, err) : no_memory(err);
    if (status == FM_OK)
        status = journal_replay(run->journal, &reader, &run->is_damaged, err);
    free(all.places);
    return status;
}

fm_status run_check_codes(run_state *run, fm_error *err)
{
    const char *worker = run->desc->worker != NULL ? run->desc->worker : "/proc/self/exe";
    change_list list = { .of_case = calloc(run->plan->count + 1, sizeof *list.of_case) };
    run->program = code_hash_file(worker);
    run->drivers = json_object();
    fm_status status = list.of_case == NULL || run->drivers == NULL ? no_memory(err)
                                                                    : compare_rows(&list, run, err);
    if (status == FM_OK && run->stop_signal == 0)
        status = settle(run, &list, err);
    for (size_t i = 0; i < list.count; i++)
        text_list_free(&list.methods[i].files);
    free(list.methods);
    free(list.of_case);
    return status;
}

fm_status run_fit_code(run_state *run, size_t case_index, json_t *answer, fm_error *err)
{
    const fm_case *planned = &run->plan->cases[case_index];
    const fm_code *then = codes_of(&run->results->codes, case_index);
    fm_text_list files = { 0 };
    fm_text told = { 0 };
    fm_code code;
    fm_status status = FM_OK;
    if (!answer_code(&code, answer)) { /* it died, or never began */
        code_free(&code);
        run_guess_code(run, case_index, answer);
        (void)answer_code(&code, answer);
    }
    note_driver(run, planned->device, code.driver);
    const uint32_t changes = then != NULL ? code_changes(&files, then, &code) : 0;
    if (changes != 0) {
        say_what(&told, changes, &files);
        run->is_other_code = true;
        status = fm_fail(err, FM_INVALID,
                         "%s %s: other code than the row began with: %.1500s. The launch is not "
                         "kept; the same command with --fresh measures the row anew",
                         planned->method, planned->id, told.bytes != NULL ? told.bytes : "");
    }
    text_free(&told);
    text_list_free(&files);
    code_free(&code);
    return status;
}

/* Its own file, so that a truth and what made it stay together whoever moves or removes them. */
static fm_status code_path(char path[FM_PATH_MAX_BYTES], const char *truth, fm_error *err)
{
    const int length = snprintf(path, FM_PATH_MAX_BYTES, "%s.code", truth);
    if (length < 0 || length >= FM_PATH_MAX_BYTES)
        return fm_fail(err, FM_INVALID, "%s: path too long", truth);
    return FM_OK;
}

fm_status run_keep_truth_code(const run_state *run, const char *path, const json_t *answer,
                              fm_error *err)
{
    char file[FM_PATH_MAX_BYTES];
    fm_code code;
    if (!answer_code(&code, answer))
        code.program = run->program;
    json_t *json = code_to_json(&code);
    char *text = json != NULL ? json_dumps(json, JSON_COMPACT) : NULL;
    fm_status status = code_path(file, path, err);
    if (status == FM_OK)
        status = text != NULL ? text_write_file(file, text, strlen(text), err) : no_memory(err);
    free(text);
    json_decref(json);
    code_free(&code);
    return status;
}

fm_status run_find_truth(bool *is_there, run_state *run, size_t job, const char *path,
                         fm_error *err)
{
    char file[FM_PATH_MAX_BYTES];
    const size_t case_index = run->truths.jobs[job].of;
    uint32_t changes = 0;
    fm_text_list names = { 0 };
    fm_code code = { 0 };
    fm_status status = code_path(file, path, err);
    *is_there = false;
    if (status != FM_OK)
        return status;
    json_t *json = access(path, R_OK) == 0 ? json_load_file(file, 0, NULL) : NULL;
    *is_there = code_from_json(&code, json);
    if (*is_there)
        status = compare_row(&changes, &names, run, case_index, &code, err);
    *is_there = *is_there && status == FM_OK && changes == 0;
    if (status == FM_OK && run->stop_signal == 0 && !*is_there) {
        unlink(path);
        unlink(file);
        if (snprintf(file, sizeof file, "%s.hull", path) < (int)sizeof file)
            unlink(file);
    }
    text_list_free(&names);
    json_decref(json);
    code_free(&code);
    return status;
}
