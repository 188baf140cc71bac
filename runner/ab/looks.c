#include "looks.h"

#include <math.h>
#include <stdlib.h>

#include "decide/levels.h"

ab_statistic looks_decisive(const ab_tested *tested)
{
    return tested->differences[AB_CPU] != NULL ? AB_CPU : AB_TIME;
}

static bool is_tested(const ab_judged *judged)
{
    return judged->pairs >= AB_PAIRS_LEAST;
}

/* One test among others. */
typedef struct test_place {
    ab_judged *judged; /* NULL: it was decided earlier, and stays as it was */
    double p;
} test_place;

/* Adjusts the p-values of tests for one another. */
static fm_status adjust(test_place *tests, size_t count, fm_error *err)
{
    double *p = calloc(count + 1, sizeof *p);
    if (p == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for %zu tests", count);
    for (size_t i = 0; i < count; i++)
        p[i] = tests[i].p;
    const fm_status status = levels_adjust(p, p, count, err);
    for (size_t i = 0; i < count && status == FM_OK; i++)
        if (tests[i].judged != NULL)
            tests[i].judged->adjusted = p[i];
    free(p);
    return status;
}

static fm_status judge_open(ab_tested *tested, const ab_policy *policy, size_t look, fm_error *err)
{
    fm_status status = FM_OK;
    for (int s = 0; s < AB_STATISTIC_COUNT && status == FM_OK; s++)
        if (tested->differences[s] != NULL)
            status = judge_pairs(&tested->judged[s], tested->differences[s], policy->looks[look],
                                 policy, 1.0 - policy->levels[look], tested->least[s], err);
    tested->looks_seen = (uint32_t)look + 1;
    return status;
}

static bool has_verdict(const ab_tested *tested, ab_verdict verdict)
{
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        if (tested->differences[s] != NULL && tested->judged[s].verdict == verdict)
            return true;
    return false;
}

static ab_verdict combine(const ab_tested *tested)
{
    if (has_verdict(tested, AB_WORSE))
        return AB_WORSE;
    if (has_verdict(tested, AB_BETTER))
        return AB_BETTER;
    return tested->judged[looks_decisive(tested)].verdict;
}

static void decide(ab_tested *tested, const ab_policy *policy, size_t look)
{
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        if (tested->differences[s] != NULL)
            judge_verdict(&tested->judged[s], policy, look);
    tested->verdict = combine(tested);
    tested->is_decided = tested->verdict != AB_UNCLEAR || look + 1 == policy->look_count;
}

static bool is_open(const ab_tested *tested)
{
    return !tested->is_decided && !tested->is_out;
}

/* What was decided keeps the p that decided it, and its place among the tests. */
static fm_status adjust_all(ab_tested *cases, size_t count, fm_error *err)
{
    size_t used = 0;
    test_place *tests = calloc(count * AB_STATISTIC_COUNT + 1, sizeof *tests);
    if (tests == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the tests of %zu cases", count);
    for (size_t i = 0; i < count; i++)
        for (int s = 0; s < AB_STATISTIC_COUNT; s++)
            if (is_tested(&cases[i].judged[s]))
                tests[used++] = (test_place){ is_open(&cases[i]) ? &cases[i].judged[s] : NULL,
                                              cases[i].judged[s].p };
    const fm_status status = adjust(tests, used, err);
    free(tests);
    return status;
}

fm_status looks_judge(ab_tested *cases, size_t count, const ab_policy *policy, size_t look,
                      fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < count && status == FM_OK; i++)
        if (is_open(&cases[i]))
            status = judge_open(&cases[i], policy, look, err);
    if (status == FM_OK)
        status = adjust_all(cases, count, err);
    for (size_t i = 0; i < count && status == FM_OK; i++)
        if (is_open(&cases[i]))
            decide(&cases[i], policy, look);
    return status;
}

bool looks_suspects(const ab_tested *tested)
{
    return tested->is_decided && !tested->is_out && tested->verdict == AB_WORSE &&
           !tested->is_confirmed;
}

/* Only what was worse before can be confirmed. */
static fm_status judge_again(ab_tested *tested, const ab_policy *policy, fm_error *err)
{
    const uint32_t first = ab_policy_confirm_first(policy);
    fm_status status = FM_OK;
    for (int s = 0; s < AB_STATISTIC_COUNT && status == FM_OK; s++)
        if (tested->differences[s] != NULL && tested->judged[s].verdict == AB_WORSE)
            status =
                judge_pairs(&tested->confirmed[s], tested->differences[s] + first, policy->looks[0],
                            policy, 1.0 - policy->confirm_level, tested->least[s], err);
    return status;
}

static fm_status adjust_suspects(ab_tested *cases, size_t count, fm_error *err)
{
    size_t used = 0;
    test_place *tests = calloc(count * AB_STATISTIC_COUNT + 1, sizeof *tests);
    if (tests == NULL)
        return fm_fail(err, FM_NO_MEMORY, "no memory for the tests of %zu cases", count);
    for (size_t i = 0; i < count; i++)
        for (int s = 0; s < AB_STATISTIC_COUNT; s++)
            if (looks_suspects(&cases[i]) && is_tested(&cases[i].confirmed[s]))
                tests[used++] =
                    (test_place){ &cases[i].confirmed[s], cases[i].confirmed[s].p_greater };
    const fm_status status = adjust(tests, used, err);
    free(tests);
    return status;
}

/* Whether it counts was judged before, mostly by more pairs: here it is only to be there again.
 * Where the machine is as noisy as the band says, half of it is what the level asks for, too. */
static void confirm(ab_tested *tested, const ab_policy *policy)
{
    for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
        ab_judged *again = &tested->confirmed[s];
        if (!is_tested(again))
            continue;
        const bool is_there = again->adjusted <= policy->confirm_level &&
                              again->shift.interval.median >= 0.5 * again->band;
        again->verdict = is_there ? AB_WORSE : AB_UNCLEAR;
        tested->is_confirmed = tested->is_confirmed || again->verdict == AB_WORSE;
    }
    tested->is_not_confirmed = !tested->is_confirmed;
    tested->verdict = tested->is_confirmed ? AB_WORSE : AB_UNCLEAR;
}

fm_status looks_confirm(ab_tested *cases, size_t count, const ab_policy *policy, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < count && status == FM_OK; i++)
        if (looks_suspects(&cases[i]))
            status = judge_again(&cases[i], policy, err);
    if (status == FM_OK)
        status = adjust_suspects(cases, count, err);
    for (size_t i = 0; i < count && status == FM_OK; i++)
        if (looks_suspects(&cases[i]))
            confirm(&cases[i], policy);
    return status;
}
