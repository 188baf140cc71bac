/* What a person reads. */
#include <math.h>
#include <stdlib.h>

#include "ab.h"

/* The worst first; in each verdict the largest effect. */
static int compare_cases(const void *left, const void *right)
{
    const ab_case *a = *(const ab_case *const *)left, *b = *(const ab_case *const *)right;
    const double x = a->tested.judged[looks_decisive(&a->tested)].shift.interval.median,
                 y = b->tested.judged[looks_decisive(&b->tested)].shift.interval.median;
    if (a->verdict != b->verdict)
        return a->verdict < b->verdict ? -1 : 1;
    if (x != y && !isnan(x) && !isnan(y))
        return x > y ? -1 : 1;
    return a < b ? -1 : a > b;
}

/* Logarithms as percent: 0.0198 is +2.0. */
static double percent(double difference)
{
    return 100.0 * expm1(difference);
}

static void add_statistic(fm_text *text, const ab_judged *judged)
{
    const fm_interval *interval = &judged->shift.interval;
    char range[48];
    if (judged->pairs < AB_PAIRS_LEAST) {
        text_add(text, "%24s", "");
        return;
    }
    snprintf(range, sizeof range, "%+.1f..%+.1f", percent(interval->low), percent(interval->high));
    text_add(text, " %+7.1f %15s", percent(interval->median), range);
}

static void add_case(fm_text *text, const ab_case *of, const ab_policy *policy)
{
    const ab_statistic decisive = looks_decisive(&of->tested);
    const ab_judged *judged = &of->tested.judged[decisive];
    fm_text why = { 0 };
    text_add(text, "%-10s", ab_verdict_name(of->verdict));
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        add_statistic(text, &of->tested.judged[s]);
    if (judged->pairs >= AB_PAIRS_LEAST)
        text_add(text, " %6.1f %5zu", percent(judged->band), judged->pairs);
    else
        text_add(text, "%13s", "");
    ab_why(&why, of, policy);
    text_add(text, "  %s%s%s\n", of->name, why.length > 0 ? "; " : "",
             why.length > 0 ? why.bytes : "");
    text_free(&why);
}

static void add_summary(fm_text *text, const ab_result *result)
{
    text_add(text, "\n%zu case%s:", result->count, result->count == 1 ? "" : "s");
    for (int i = 0; i < AB_VERDICT_COUNT; i++)
        text_add(text, "%s %zu %s", i > 0 ? "," : "", ab_count(result, (ab_verdict)i),
                 ab_verdict_name((ab_verdict)i));
    text_add(text, "; %u pairs of launches", result->measured_pairs);
    if (result->pairs.unpaired > 0)
        text_add(text, "; %zu cases in one side alone", result->pairs.unpaired);
    if (result->pairs.refused > 0)
        text_add(text, "; %zu that neither side can run", result->pairs.refused);
    text_add(text, "\n");
}

void ab_add_lines(fm_text *text, const ab_result *result, const ab_policy *policy)
{
    const ab_case **order = calloc(result->count + 1, sizeof *order);
    if (order == NULL) {
        text->failed = true;
        return;
    }
    for (size_t i = 0; i < result->count; i++)
        order[i] = &result->cases[i];
    qsort(order, result->count, sizeof *order, compare_cases);
    text_add(text, "NEW over BASE in percent, with the interval of the look that decided\n");
    text_add(text, "%-10s %7s %15s %7s %15s %6s %5s  case\n", "verdict", "time", "interval", "cpu",
             "interval", "band", "pairs");
    for (size_t i = 0; i < result->count; i++)
        add_case(text, order[i], policy);
    add_summary(text, result);
    free(order);
}
