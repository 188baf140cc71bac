#include <math.h>

#include "ab.h"

/* JSON has no number for what is not known. */
static json_t *number(double value)
{
    return isfinite(value) ? json_real(value) : json_null();
}

static json_t *ratios(const fm_interval *interval)
{
    return json_pack("[o, o, o]", number(exp(interval->median)), number(exp(interval->low)),
                     number(exp(interval->high)));
}

static json_t *judged_json(const ab_judged *judged)
{
    return json_pack("{s:s, s:I, s:o, s:o, s:o, s:o, s:o, s:I}", "verdict",
                     ab_verdict_name(judged->verdict), "pairs", (json_int_t)judged->pairs,
                     "median_ratio", ratios(&judged->median.interval), "shift_ratio",
                     ratios(&judged->shift.interval), "p", number(judged->p), "p_adjusted",
                     number(judged->adjusted), "band", number(exp(judged->band)), "pairs_wanted",
                     (json_int_t)judged->pairs_wanted);
}

static json_t *case_json(const ab_case *of, const ab_policy *policy)
{
    fm_text why = { 0 };
    json_t *statistics = json_object();
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        if (of->tested.judged[s].pairs >= AB_PAIRS_LEAST)
            json_object_set_new(statistics, ab_statistic_names[s],
                                judged_json(&of->tested.judged[s]));
    }
    ab_why(&why, of, policy);
    json_t *json = json_pack(
        "{s:s, s:s, s:s, s:s, s:b, s:s, s:s, s:s, s:s, s:s, s:o}", "case", of->name, "case_id_base",
        of->planned[AB_BASE]->id, "case_id_new", of->planned[AB_NEW]->id, "verdict",
        ab_verdict_name(of->verdict), "is_confirmed", (int)of->tested.is_confirmed, "outputs",
        ab_outputs_name(of->outputs), "changes", of->changes.length > 0 ? of->changes.bytes : "",
        "status_base", case_status_name(of->status[AB_BASE]), "status_new",
        case_status_name(of->status[AB_NEW]), "why", why.length > 0 ? why.bytes : "", "statistics",
        statistics);
    text_free(&why);
    return json;
}

static json_t *policy_json(const ab_policy *policy)
{
    json_t *looks = json_array(), *levels = json_array();
    for (size_t i = 0; i < policy->look_count; i++) {
        json_array_append_new(looks, json_integer(policy->looks[i]));
        json_array_append_new(levels, json_real(policy->levels[i]));
    }
    return json_pack("{s:o, s:o, s:f, s:f, s:f}", "looks", looks, "levels", levels, "level",
                     policy->level, "confirm_level", policy->confirm_level, "band", policy->band);
}

json_t *ab_json(const ab_result *result, const ab_policy *policy)
{
    json_t *cases = json_array(), *verdicts = json_object();
    for (size_t i = 0; i < result->count; i++)
        json_array_append_new(cases, case_json(&result->cases[i], policy));
    for (int i = 0; i < AB_VERDICT_COUNT; i++)
        json_object_set_new(verdicts, ab_verdict_name((ab_verdict)i),
                            json_integer((json_int_t)ab_count(result, (ab_verdict)i)));
    return json_pack("{s:i, s:b, s:o, s:o, s:o, s:I}", "schema", 1, "is_finished",
                     (int)result->is_finished, "policy", policy_json(policy), "verdicts", verdicts,
                     "cases", cases, "pairs", (json_int_t)result->measured_pairs);
}
