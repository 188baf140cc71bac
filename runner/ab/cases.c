#include "cases.h"

#include <math.h>
#include <stdlib.h>

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

fm_status cases_make(ab_result *result, const ab_desc *desc, fm_error *err)
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

void cases_update(ab_session *session)
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
