#include "judging.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "bounds.h"
#include "model/metrics.h"

void judging_begin(judging *to)
{
    to->worst = (decision){ .kind = FM_VERDICT_NOT_TESTABLE, .measured = { NAN, NAN, NAN } };
    to->least = INFINITY;
    to->greatest = -INFINITY;
}

static int rank(fm_verdict_kind kind)
{
    static const int ranks[FM_VERDICT_COUNT] = { [FM_VERDICT_NOT_TESTABLE] = 0,
                                                 [FM_VERDICT_HOLDS] = 1,
                                                 [FM_VERDICT_IN_PART] = 1,
                                                 [FM_VERDICT_UNCLEAR] = 2,
                                                 [FM_VERDICT_FAILS] = 3 };
    return ranks[kind];
}

void judging_decide(judging *to, const decision *made)
{
    const double sign = to->claim->form == FM_CLAIM_ANY ? -1.0 : 1.0;
    const int apart = rank(made->kind) - rank(to->worst.kind);
    const bool is_testable = made->kind != FM_VERDICT_NOT_TESTABLE;
    const bool was_testable = to->worst.kind != FM_VERDICT_NOT_TESTABLE;
    const bool is_worse =
        apart == 0 ? sign * made->margin < sign * to->worst.margin : sign * apart > 0.0;
    if (to->count == 0 || (is_testable && !was_testable) ||
        (is_worse && is_testable == was_testable))
        to->worst = *made;
    to->least = fmin(to->least, made->measured.median);
    to->greatest = fmax(to->greatest, made->measured.median);
    to->count++;
}

void judging_value(judging *to, fm_interval value, const fm_claim_point *a, const fm_claim_point *b)
{
    const decision made = { bounds_judge(to->claim, value), value,
                            bounds_margin(to->claim, value.median), a, b };
    judging_decide(to, &made);
}

void judging_rise(judging *to, const fm_claim_point *point, const fm_claim_point *next,
                  double least)
{
    const fm_interval rise = interval_difference(next->value, point->value);
    decision made = { .measured = interval_ratio(next->value, point->value),
                      .a = point,
                      .b = next };
    if (point->value.median == 0.0)
        made.measured = next->value; /* a ratio to nothing says nothing */
    made.margin = rise.median / fmax(fabs(point->value.median), 1e-12);
    if (rise.low >= least)
        made.kind = FM_VERDICT_HOLDS;
    else
        made.kind = rise.high < least ? FM_VERDICT_FAILS : FM_VERDICT_UNCLEAR;
    judging_decide(to, &made);
}

void judging_step(judging *to, const fm_claim_point *point, const fm_claim_point *next)
{
    judging_rise(to, point, next, -to->claim->tolerance * fabs(point->value.median));
}

static void keep_note(judging *to, const char *format, va_list arguments)
{
    if (to->note[0] == '\0')
        vsnprintf(to->note, sizeof to->note, format, arguments);
}

void judging_note(judging *to, const char *format, ...)
{
    va_list arguments;
    va_start(arguments, format);
    keep_note(to, format, arguments);
    va_end(arguments);
}

void judging_skip(judging *to, const fm_claim_point *points, size_t count, const char *format, ...)
{
    va_list arguments;
    for (size_t i = 0; i < count; i++)
        to->skipped += !points[i].is_incomplete;
    va_start(arguments, format);
    keep_note(to, format, arguments);
    va_end(arguments);
}

static void add(fm_verdict *verdict, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* Parts of the reason, with "; " between them; what does not fit is left out. */
static void add(fm_verdict *verdict, const char *format, ...)
{
    size_t used = strlen(verdict->reason);
    va_list arguments;
    if (used > 0 && used + 3 < sizeof verdict->reason) {
        memcpy(verdict->reason + used, "; ", 3);
        used += 2;
    }
    va_start(arguments, format);
    vsnprintf(verdict->reason + used, sizeof verdict->reason - used, format, arguments);
    va_end(arguments);
}

/* Which points decided, by what tells them from the others. */
static void name_deciders(fm_verdict *verdict, const judging *to)
{
    char a[160], b[160] = "";
    if (to->worst.a == NULL)
        return;
    bool *used = calloc(to->rows->results->count + 1, sizeof *used);
    for (size_t i = 0; used != NULL && i < to->points->count; i++)
        if (to->points->points[i].result != NULL)
            used[to->points->points[i].result - to->rows->results->cases] = true;
    claim_point_name(a, to->rows, used, to->worst.a);
    if (to->worst.b != NULL)
        claim_point_name(b, to->rows, used, to->worst.b);
    add(verdict, "%s: %s%s%s", to->claim->form == FM_CLAIM_ANY ? "best" : "decided at", a,
        to->worst.b != NULL ? " / " : "", b);
    free(used);
}

/* Why an interval does not decide. */
static void explain_unclear(fm_verdict *verdict, const judging *to)
{
    static const char *const why[FM_CLAIM_FORM_COUNT] = {
        [FM_CLAIM_ORDER] = "the interval of this step allows both ways",
        [FM_CLAIM_MONOTONE] = "the interval of this step allows both ways",
        [FM_CLAIM_CROSSING] = "the interval reaches beyond what is claimed",
        [FM_CLAIM_PEAK] = "values that reach beyond what is claimed may be as good",
    };
    double bounds[2];
    const fm_interval *value = &to->worst.measured;
    bounds_of(bounds, to->claim);
    if (!interval_is_known(value))
        add(verdict, "unclear: one launch has no interval: run with -a launches=%d or more",
            FM_LAUNCHES_WANTED);
    else if (why[to->claim->form] != NULL)
        add(verdict, "unclear: %s", why[to->claim->form]);
    else if (isinf(value->low) && isinf(value->high))
        add(verdict, "unclear: what it is divided by may be 0, within its interval");
    else
        add(verdict, "unclear: the interval crosses the bound %.4g",
            value->low < bounds[0] ? bounds[0] : bounds[1]);
}

static size_t count_incomplete(const fm_claim_points *points)
{
    size_t count = 0;
    for (size_t i = 0; i < points->count; i++)
        count += points->points[i].is_incomplete;
    return count;
}

/* What was left out might have decided otherwise: of all points against a claim that holds, of any
 * point for one that fails. Where no point is whole, nothing was judged; but what must hold fails
 * by any point. */
static void count_points(fm_verdict *verdict, const judging *to)
{
    const fm_claim_points *points = to->points;
    const bool is_any = to->claim->form == FM_CLAIM_ANY;
    const size_t left_out = to->skipped + count_incomplete(points);
    verdict->total = points->count + points->missing_count;
    verdict->judged = points->count - left_out;
    if (verdict->judged == verdict->total)
        return;
    if (verdict->kind == FM_VERDICT_HOLDS && !is_any)
        verdict->kind = FM_VERDICT_IN_PART;
    if (verdict->kind == FM_VERDICT_FAILS && is_any)
        verdict->kind = FM_VERDICT_UNCLEAR;
    const bool must_hold = verdict->kind == FM_VERDICT_FAILS && to->claim->is_required;
    if (verdict->kind != FM_VERDICT_NOT_TESTABLE && verdict->judged == 0 && !must_hold)
        verdict->kind = FM_VERDICT_UNCLEAR;
}

void judging_end(fm_verdict *verdict, const judging *to)
{
    size_t unknown = 0;
    const size_t incomplete = count_incomplete(to->points);
    *verdict = (fm_verdict){ .kind = to->worst.kind, .measured = to->worst.measured };
    count_points(verdict, to);
    if (to->count > 1)
        add(verdict, "%zu compared, %.4g to %.4g", to->count, to->least, to->greatest);
    name_deciders(verdict, to);
    if (to->worst.kind == FM_VERDICT_UNCLEAR)
        explain_unclear(verdict, to);
    else if (verdict->kind == FM_VERDICT_UNCLEAR && verdict->judged == 0)
        add(verdict, "unclear: no point is whole");
    for (size_t i = 0; i < to->points->count; i++)
        unknown += !interval_is_known(&to->points->points[i].value);
    if (unknown > 0 && interval_is_known(&to->worst.measured))
        add(verdict, "%zu of one launch, which has no interval", unknown);
    if (to->note[0] != '\0')
        add(verdict, "%s", to->note);
    if (to->points->missing_count > 0)
        add(verdict, "%zu left out (%s)", to->points->missing_count, to->points->missing);
    if (incomplete > 0)
        add(verdict, "%zu of fewer rows than were asked for (%s)", incomplete,
            to->points->incomplete);
}
