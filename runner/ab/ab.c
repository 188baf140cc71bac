#include "ab.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "pairs.h"

/* ---- the cases, before anything is measured */

static double *make_numbers(uint32_t count)
{
    double *numbers = malloc(count * sizeof *numbers);
    for (uint32_t i = 0; i < count && numbers != NULL; i++)
        numbers[i] = NAN;
    return numbers;
}

static bool make_case(ab_case *made, const ab_pair *pair, const ab_desc *desc, uint32_t room)
{
    fm_text name = { 0 };
    bool is_made = true;
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        made->planned[side] = &desc->plans[side]->cases[pair->at[side]];
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        for (int side = 0; side < AB_SIDE_COUNT; side++) {
            made->numbers[side][s] = make_numbers(room);
            is_made = is_made && made->numbers[side][s] != NULL;
        }
        made->differences[s] = make_numbers(room);
        is_made = is_made && made->differences[s] != NULL;
    }
    side_case_name(&name, made->planned[AB_BASE]);
    snprintf(made->name, sizeof made->name, "%s", name.bytes != NULL ? name.bytes : "");
    text_free(&name);
    made->outputs = AB_OUTPUTS_EQUAL;
    made->verdict = AB_UNMEASURED;
    return is_made;
}

static fm_status make_cases(ab_result *result, const ab_desc *desc, fm_error *err)
{
    bool is_made;
    fm_status status = sides_join(&result->pairs, desc->plans[AB_BASE], desc->plans[AB_NEW], err);
    if (status != FM_OK)
        return status;
    result->seed = desc->plans[AB_BASE]->seed;
    result->pair_room = ab_policy_pairs(desc->policy);
    result->confirm_first = ab_policy_confirm_first(desc->policy);
    result->cases = calloc(result->pairs.count, sizeof *result->cases);
    is_made = result->cases != NULL;
    for (size_t i = 0; i < result->pairs.count && is_made; i++) {
        is_made = make_case(&result->cases[i], &result->pairs.items[i], desc, result->pair_room);
        result->count++;
    }
    return is_made ? FM_OK
                   : fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", result->pairs.count);
}

/* Each launch of a side is one of a pair. */
static void set_launches(fm_plan *plan, uint32_t launches)
{
    plan->launches = launches;
    for (size_t i = 0; i < plan->count; i++)
        plan->cases[i].settings.launches = launches;
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

/* ---- what the runs know of the cases */

static bool is_racy(const fm_plugin_list *plugins, const char *method)
{
    const fm_plugin_entry *entry = plugin_list_find(plugins, method);
    return entry != NULL && entry->plugin != NULL &&
           (entry->plugin->method->traits & FM_TRAIT_RACY) != 0;
}

static const fm_case_result *result_of(const ab_session *session, size_t index, int side)
{
    return &run_results(session->runs[side])->cases[session->result->pairs.items[index].at[side]];
}

static void compare_outputs(ab_session *session, size_t index)
{
    ab_case *of = &session->result->cases[index];
    ab_output_side sides[AB_SIDE_COUNT];
    for (int side = 0; side < AB_SIDE_COUNT; side++) {
        const fm_case_result *result = result_of(session, index, side);
        sides[side] = (ab_output_side){
            .result = result,
            .is_racy = is_racy(session->desc->plugins[side], of->planned[side]->method),
        };
        of->status[side] = result->status;
        snprintf(of->message[side], sizeof of->message[side], "%.511s", result->message);
    }
    text_free(&of->changes);
    of->outputs = outputs_compare(&of->changes, &sides[AB_BASE], &sides[AB_NEW]);
}

/* Which statistics a case has, and what is known of their noise. */
static void choose_statistics(ab_session *session, size_t index)
{
    ab_case *of = &session->result->cases[index];
    const ab_policy *policy = session->desc->policy;
    const fm_case_result *base = result_of(session, index, AB_BASE),
                         *now = result_of(session, index, AB_NEW);
    snprintf(of->device_name, sizeof of->device_name, "%s", base->device_name);
    of->tested.differences[AB_TIME] = of->differences[AB_TIME];
    of->tested.differences[AB_CPU] =
        base->is_software && now->is_software ? of->differences[AB_CPU] : NULL;
    for (int s = 0; s < AB_STATISTIC_COUNT && session->desc->noise != NULL; s++)
        of->tested.least[s] =
            noise_least(session->desc->noise, of->device_name, (ab_statistic)s, policy);
}

static ab_verdict verdict_of(const ab_case *of)
{
    const ab_verdict timed = of->tested.verdict;
    if (of->outputs == AB_OUTPUTS_WORSE)
        return AB_WORSE;
    if (of->tested.looks_seen == 0)
        return of->outputs == AB_OUTPUTS_BETTER ? AB_BETTER : AB_UNMEASURED;
    return of->outputs == AB_OUTPUTS_BETTER && (timed == AB_SAME || timed == AB_UNMEASURED)
               ? AB_BETTER
               : timed;
}

/* After each stage: statuses may have become worse. */
static void update(ab_session *session)
{
    for (size_t i = 0; i < session->result->count; i++) {
        ab_case *of = &session->result->cases[i];
        compare_outputs(session, i);
        choose_statistics(session, i);
        of->tested.is_out =
            session->desc->policy->stops_at_outputs && of->outputs == AB_OUTPUTS_WORSE;
        of->verdict = verdict_of(of);
    }
}

/* ---- the stages */

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
        update(session);
    }
    if (status == FM_OK && session->result->stop_signal == 0)
        status = pairs_measure(session, first + checked, policy->looks[look] - first - checked,
                               wants_look, err);
    if (status != FM_OK || session->result->stop_signal != 0)
        return status;
    update(session);
    status = judge(session, look, false, err);
    update(session);
    return status;
}

static fm_status measure_confirmation(ab_session *session, fm_error *err)
{
    fm_status status = pairs_measure(session, session->result->confirm_first,
                                     session->desc->policy->looks[0], wants_confirmation, err);
    if (status != FM_OK || session->result->stop_signal != 0)
        return status;
    status = judge(session, 0, true, err);
    update(session);
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

/* ---- both runs and the files */

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
    fm_status status = make_cases(result, desc, err);
    if (status == FM_OK)
        status = open_runs(&session, runs, folders, err);
    if (status == FM_OK)
        status = measure(&session, err);
    status = close_runs(&session, status, err);
    return status == FM_OK ? write_tables(result, desc, err) : status;
}

size_t ab_count(const ab_result *result, ab_verdict verdict)
{
    size_t count = 0;
    for (size_t i = 0; i < result->count; i++)
        count += result->cases[i].verdict == verdict;
    return count;
}

static void add_reason(fm_text *why, const char *reason)
{
    text_add(why, "%s%s", why->length > 0 ? "; " : "", reason);
}

static void add_unclear(fm_text *why, const ab_case *of, const ab_policy *policy)
{
    const ab_judged *judged = &of->tested.judged[looks_decisive(&of->tested)];
    char text[96];
    if (of->tested.is_not_confirmed)
        snprintf(text, sizeof text, "looked worse; %u fresh pairs did not confirm it",
                 policy->looks[0]);
    else if (judged->pairs_wanted > 0)
        snprintf(text, sizeof text, "%u pairs might decide", judged->pairs_wanted);
    else
        snprintf(text, sizeof text, "too noisy for %d pairs", DECIDE_VALUES);
    add_reason(why, text);
}

void ab_why(fm_text *why, const ab_case *of, const ab_policy *policy)
{
    char text[96];
    if (of->tested.is_confirmed) {
        snprintf(text, sizeof text, "confirmed on %u fresh pairs", policy->looks[0]);
        add_reason(why, text);
    }
    if (of->changes.length > 0)
        add_reason(why, of->changes.bytes);
    if (of->verdict == AB_UNCLEAR)
        add_unclear(why, of, policy);
    for (int side = 0; side < AB_SIDE_COUNT; side++)
        if (of->status[side] != FM_CASE_OK && of->message[side][0] != '\0')
            text_add(why, "%s%s: %s", why->length > 0 ? "; " : "", ab_side_names[side],
                     of->message[side]);
}
