#include "choose.h"

#include <math.h>
#include <string.h>

static uint32_t at_least(uint32_t value, uint32_t least)
{
    return value > least ? value : least;
}

/* Methods that have a case to run, in the order of the plan. */
static fm_status list_methods(fm_text_list *methods, const fm_plan *plan, fm_error *err)
{
    for (size_t i = 0; i < plan->count; i++)
        if (plan->cases[i].skip == NULL && !text_list_has(methods, plan->cases[i].method) &&
            !text_list_add(methods, plan->cases[i].method))
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu cases", plan->count);
    return FM_OK;
}

static fm_status take_part(fm_night_state *night, const fm_text_list *methods,
                           const char *reference, fm_error *err)
{
    for (size_t i = 0; i < methods->count; i++)
        if ((i % night->parts == night->part || strcmp(methods->items[i], reference) == 0) &&
            !text_list_add(&night->methods, methods->items[i]))
            return fm_fail(err, FM_NO_MEMORY, "no memory for %zu methods", methods->count);
    return FM_OK;
}

/* Launches of each case, or a part of the methods. */
static fm_status choose_part(fm_night_state *night, const fm_policy *policy,
                             const fm_night_past *past, const fm_plan *plan, double round_s,
                             fm_error *err)
{
    fm_text_list methods = { 0 };
    const double seconds = policy_launch_share(policy) * policy_seconds(policy, night->built_s);
    if (past->seconds_per_round > 0)
        round_s = past->seconds_per_round * past->parts;
    const double rounds = fmin(floor(seconds / fmax(round_s, 1e-3)), policy->launches_most);
    const uint32_t wanted = past->launches_needed > 0
                                ? at_least(past->launches_needed, policy->launches_least)
                                : policy->launches_most;
    night->part = 0;
    night->parts = 1;
    night->launches = policy->launches_least;
    if (rounds >= policy->launches_least) {
        night->launches = (uint32_t)fmin(rounds, wanted);
        return FM_OK;
    }
    fm_status status = list_methods(&methods, plan, err);
    const double parts = ceil(round_s * policy->launches_least / seconds);
    if (status == FM_OK && methods.count > 1) {
        night->parts = (uint32_t)fmin(parts, (double)methods.count);
        night->part = past->nights % night->parts;
        status = take_part(night, &methods, policy->reference, err);
    }
    text_list_free(&methods);
    return status;
}

/* Cases of tonight's methods that are to run. */
static void count_cases(fm_night_state *night, const fm_plan *plan)
{
    night->cases = 0;
    for (size_t i = 0; i < plan->count; i++)
        night->cases +=
            plan->cases[i].skip == NULL &&
            (night->methods.count == 0 || text_list_has(&night->methods, plan->cases[i].method));
}

fm_status choose_tonight(fm_night_state *night, const fm_policy *policy, const fm_night_past *past,
                         const fm_plan *plan, double round_s, fm_error *err)
{
    const fm_status status = choose_part(night, policy, past, plan, round_s, err);
    if (status == FM_OK)
        count_cases(night, plan);
    return status;
}
