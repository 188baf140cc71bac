#include "ab.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "cases.h"
#include "pairs.h"

static bool wants_look(const ab_case *of)
{
    return !of->tested.is_decided && !of->tested.is_out;
}

static bool wants_confirmation(const ab_case *of)
{
    return looks_suspects(&of->tested);
}

/* What is judged in one call stands together. */
static fm_status judge(ab_session *session, size_t look, bool is_confirmation, fm_error *err)
{
    ab_result *result = session->result;
    ab_tested *tested = calloc(result->count + 1, sizeof *tested);
    if (tested == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", result->count);
    for (size_t i = 0; i < result->count; i++)
        tested[i] = result->cases[i].tested;
    const fm_status status =
        is_confirmation ? looks_confirm(tested, result->count, session->desc->policy, err)
                        : looks_judge(tested, result->count, session->desc->policy, look, err);
    for (size_t i = 0; i < result->count; i++)
        result->cases[i].tested = tested[i];
    free(tested);
    return status;
}

static fm_status measure_look(ab_session *session, size_t look, fm_error *err)
{
    const ab_policy *policy = session->desc->policy;
    const uint32_t first = look == 0 ? 0 : policy->looks[look - 1];
    const uint32_t checked = look == 0 ? 1 : 0; /* outputs are compared before times */
    fm_status status = FM_OK;
    if (checked > 0) {
        status = pairs_measure(session, 0, checked, wants_look, err);
        cases_update(session);
    }
    if (status == FM_OK && session->result->stop_signal == 0)
        status = pairs_measure(session, first + checked, policy->looks[look] - first - checked,
                               wants_look, err);
    if (status != FM_OK || session->result->stop_signal != 0)
        return status;
    cases_update(session);
    status = judge(session, look, false, err);
    cases_update(session);
    return status;
}

static fm_status measure_confirmation(ab_session *session, fm_error *err)
{
    fm_status status = pairs_measure(session, session->result->confirm_first,
                                     session->desc->policy->looks[0], wants_confirmation, err);
    if (status != FM_OK || session->result->stop_signal != 0)
        return status;
    status = judge(session, 0, true, err);
    cases_update(session);
    return status;
}

static fm_status measure(ab_session *session, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t look = 0; look < session->desc->policy->look_count && status == FM_OK &&
                          session->result->stop_signal == 0;
         look++)
        status = measure_look(session, look, err);
    if (status == FM_OK && session->result->stop_signal == 0 && !session->desc->policy->only_looks)
        status = measure_confirmation(session, err);
    session->result->is_finished = status == FM_OK && session->result->stop_signal == 0;
    progress_close(&session->progress);
    return status;
}

/* Each launch of a side is one of a pair. */
static void set_launches(fm_plan *plan, uint32_t launches)
{
    plan->launches = launches;
    for (size_t i = 0; i < plan->count; i++)
        plan->cases[i].settings.launches = launches;
}

static fm_status open_runs(ab_session *session, fm_run_desc *runs,
                           char (*folders)[FM_PATH_MAX_BYTES], fm_error *err)
{
    const ab_desc *desc = session->desc;
    fm_status status = FM_OK;
    for (int side = 0; side < AB_SIDE_COUNT && status == FM_OK; side++) {
        status = path_join(folders[side], desc->directory, ab_side_names[side], err);
        if (status != FM_OK)
            break;
        set_launches(desc->plans[side], session->result->pair_room);
        runs[side] = desc->run;
        runs[side].directory = folders[side];
        runs[side].command = desc->command;
        runs[side].worker = desc->programs[side].path;
        runs[side].worker_commit = desc->programs[side].commit;
        runs[side].worker_compiler = desc->programs[side].compiler;
        runs[side].progress = NULL; /* pairs are told here */
        status = run_open(&session->runs[side], desc->plans[side], desc->plugins[side], &runs[side],
                          err);
        if (status != FM_OK)
            fm_error_prefix(err, "%s", ab_side_names[side]);
    }
    return status;
}

/* In reverse order; the first failure is the one that is told. */
static fm_status close_runs(ab_session *session, fm_status status, fm_error *err)
{
    fm_error below = { 0 };
    for (int side = AB_SIDE_COUNT - 1; side >= 0; side--) {
        fm_run_result ended;
        if (status == FM_OK && session->result->is_finished)
            run_settle(session->runs[side]);
        if (session->runs[side] != NULL) /* who asks first has the signal */
            run_stop(session->runs[side], session->result->stop_signal);
        const fm_status closed =
            run_close(&ended, session->runs[side], status, status == FM_OK ? err : &below);
        session->result->is_damaged = session->result->is_damaged || ended.is_damaged;
        session->result->is_other_code = session->result->is_other_code || ended.is_other_code;
        status = status == FM_OK ? closed : status;
    }
    return status;
}

static fm_status write_file(const char *directory, const char *name, fm_text *text, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = path_join(path, directory, name, err);
    if (status == FM_OK && text->failed)
        status = fm_fail(err, FM_NO_MEMORY, "%s: no memory", path);
    if (status == FM_OK)
        status = text_write_file(path, text->bytes, text->length, err);
    text_free(text);
    return status;
}

static fm_status write_tables(const ab_result *result, const ab_desc *desc, fm_error *err)
{
    fm_text cases = { 0 }, pairs = { 0 };
    ab_add_csv(&cases, result, desc->policy);
    ab_add_pairs(&pairs, result);
    const fm_status written = write_file(desc->directory, "ab.csv", &cases, err);
    const fm_status status =
        write_file(desc->directory, "pairs.csv", &pairs, written == FM_OK ? err : NULL);
    return written == FM_OK ? status : written;
}

fm_status ab_run(ab_result *result, const ab_desc *desc, fm_error *err)
{
    char folders[AB_SIDE_COUNT][FM_PATH_MAX_BYTES];
    fm_run_desc runs[AB_SIDE_COUNT];
    ab_session session = { .desc = desc, .result = result };
    *result = (ab_result){ 0 };
    session.progress.out = desc->run.progress;
    session.progress.always = desc->run.talk;
    session.progress.is_terminal = desc->run.progress != NULL && isatty(fileno(desc->run.progress));
    fm_status status = cases_make(result, desc, err);
    if (status == FM_OK)
        status = open_runs(&session, runs, folders, err);
    if (status == FM_OK)
        status = measure(&session, err);
    status = close_runs(&session, status, err);
    return status == FM_OK ? write_tables(result, desc, err) : status;
}

void ab_free(ab_result *result)
{
    for (size_t i = 0; i < result->count; i++) {
        for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
            for (int side = 0; side < AB_SIDE_COUNT; side++)
                free(result->cases[i].numbers[side][s]);
            free(result->cases[i].differences[s]);
        }
        text_free(&result->cases[i].changes);
    }
    free(result->cases);
    sides_free(&result->pairs);
    *result = (ab_result){ 0 };
}
