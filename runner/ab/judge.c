#include "judge.h"

#include <math.h>
#include <stdlib.h>

#include "decide/levels.h"
#include "decide/signed_rank.h"

const char *const ab_statistic_names[AB_STATISTIC_COUNT] = { "time", "cpu" };

const char *ab_verdict_name(ab_verdict verdict)
{
    static const char *const names[] = {
        [AB_WORSE] = "worse", [AB_UNMEASURED] = "unmeasured", [AB_UNCLEAR] = "unclear",
        [AB_SAME] = "same",   [AB_BETTER] = "better",
    };
    _Static_assert(sizeof names / sizeof names[0] == AB_VERDICT_COUNT, "one name per verdict");
    return names[verdict];
}

uint32_t ab_policy_confirm_first(const ab_policy *policy)
{
    return policy->looks[policy->look_count - 1];
}

uint32_t ab_policy_pairs(const ab_policy *policy)
{
    return ab_policy_confirm_first(policy) + policy->looks[0];
}

static fm_status check_looks(const ab_policy *policy, fm_error *err)
{
    for (size_t i = 0; i < policy->look_count; i++) {
        const uint32_t least = i == 0 ? AB_PAIRS_LEAST : policy->looks[i - 1] + 1;
        if (policy->looks[i] < least)
            return fm_fail(err, FM_INVALID, "a look at %u pairs: at least %u here",
                           policy->looks[i], least);
    }
    return policy->look_count > 0 && ab_policy_pairs(policy) > DECIDE_VALUES
               ? fm_fail(err, FM_INVALID, "%u pairs with those of a confirmation: at most %d",
                         ab_policy_pairs(policy), DECIDE_VALUES)
               : FM_OK;
}

fm_status ab_policy_make(ab_policy *policy, const uint32_t *looks, fm_error *err)
{
    static const uint32_t usual[] = { 20, 40, 0 };
    *policy = (ab_policy){ .level = 0.05, .confirm_level = 0.1, .band = 0.02 };
    looks = looks != NULL ? looks : usual;
    for (; looks[policy->look_count] != 0; policy->look_count++) {
        if (policy->look_count == AB_LOOKS)
            return fm_fail(err, FM_INVALID, "more than %d looks", AB_LOOKS);
        policy->looks[policy->look_count] = looks[policy->look_count];
    }
    fm_status status = check_looks(policy, err);
    if (status == FM_OK)
        status =
            levels_split(policy->levels, policy->looks, policy->look_count, policy->level, err);
    return status;
}

/* The differences that there are; the caller frees. */
static double *known_of(size_t *known, const double *differences, size_t count)
{
    double *values = malloc((count + 1) * sizeof *values);
    *known = 0;
    for (size_t i = 0; i < count && values != NULL; i++)
        if (!isnan(differences[i]))
            values[(*known)++] = differences[i];
    return values;
}

static fm_status judge_known(ab_judged *judged, const double *values, double coverage,
                             fm_error *err)
{
    fm_signed_rank test;
    fm_status status = signed_rank_test(&test, values, judged->pairs, err);
    if (status == FM_OK)
        status = walsh_shift(&judged->shift, values, judged->pairs, coverage, err);
    if (status == FM_OK)
        status = median_bootstrap(&judged->median, values, judged->pairs, coverage, err);
    if (status != FM_OK)
        return status;
    judged->p = test.p_two_sided;
    judged->p_greater = test.p_greater;
    return FM_OK;
}

/* Half of a 95 % interval is 1.96 standard errors of what is normal, as estimates of many pairs
 * are. */
static fm_status shift_error(double *error, const double *values, size_t count, fm_error *err)
{
    fm_shift shift;
    const fm_status status = walsh_shift(&shift, values, count, 0.95, err);
    *error = status == FM_OK && interval_is_known(&shift.interval)
                 ? (shift.interval.high - shift.interval.low) / (2.0 * 1.96)
                 : 0.0;
    return status;
}

static fm_status guess_least(double *least, const ab_judged *judged, const double *values,
                             uint32_t planned, fm_error *err)
{
    double error;
    const fm_status status = shift_error(&error, values, judged->pairs, err);
    *least = AB_ERRORS_THAT_COUNT * fmax(error, judged->median.standard_error) *
             sqrt((double)judged->pairs / (double)planned);
    return status;
}

fm_status judge_pairs(ab_judged *judged, const double *differences, size_t count,
                      const ab_policy *policy, double coverage, double least, fm_error *err)
{
    static const fm_interval none = { NAN, NAN, NAN };
    *judged = (ab_judged){ .median.interval = none,
                           .shift.interval = none,
                           .p = 1.0,
                           .p_greater = 1.0,
                           .adjusted = 1.0,
                           .band = log1p(policy->band),
                           .verdict = AB_UNMEASURED };
    double *values = known_of(&judged->pairs, differences, count);
    if (values == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu pairs", count);
    const bool is_judged = judged->pairs >= AB_PAIRS_LEAST;
    fm_status status = is_judged ? judge_known(judged, values, coverage, err) : FM_OK;
    if (status == FM_OK && is_judged && least == 0.0)
        status = guess_least(&least, judged, values, policy->looks[0], err);
    judged->band = fmax(judged->band, least);
    free(values);
    return status;
}

/* The estimate itself is no smaller than what counts anywhere. */
static bool has_counting_estimate(const ab_judged *judged, const ab_policy *policy)
{
    return fabs(judged->shift.interval.median) >= log1p(policy->band);
}

/* Half an interval falls with the root of the number of pairs: to be inside the band, or beside 0
 * where the estimate counts, whichever is nearer. */
static uint32_t wanted_pairs(const ab_judged *judged, const ab_policy *policy)
{
    const fm_interval *interval = &judged->shift.interval;
    const double half = 0.5 * (interval->high - interval->low), off = fabs(interval->median);
    const double inside = judged->band - off;
    const double room = has_counting_estimate(judged, policy) ? fmax(off, inside) : inside;
    const double pairs = ceil((double)judged->pairs * (half / room) * (half / room));
    return pairs <= DECIDE_VALUES ? (uint32_t)fmax(pairs, (double)judged->pairs + 1.0) : 0;
}

void judge_verdict(ab_judged *judged, const ab_policy *policy, size_t look)
{
    const fm_interval *interval = &judged->shift.interval;
    const bool is_certain = judged->adjusted <= policy->levels[look];
    judged->pairs_wanted = 0;
    if (judged->pairs < AB_PAIRS_LEAST)
        judged->verdict = AB_UNMEASURED;
    else if (interval->low > -judged->band && interval->high < judged->band)
        judged->verdict = AB_SAME;
    else if (is_certain && has_counting_estimate(judged, policy))
        judged->verdict = interval->median > 0.0 ? AB_WORSE : AB_BETTER;
    else {
        judged->verdict = AB_UNCLEAR;
        judged->pairs_wanted = interval_is_known(interval) ? wanted_pairs(judged, policy) : 0;
    }
}
