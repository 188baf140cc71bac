/* Loops of a descriptor: ranges of passes that nest and end. */
#include "check_method.h"
#include "model/formula.h"

typedef struct range {
    size_t first, last; /* passes, both counted in */
} range;

/* A host pass inside, whose hook may answer that the loop is over. */
static bool is_ended_by_hook(const fm_method_desc *method, const range *r)
{
    for (size_t i = r->first; method->after != NULL && i <= r->last; i++)
        if (method->passes[i].kind == FM_PASS_HOST)
            return true;
    return false;
}

static fm_status check_loop(range *r, const fm_checked_method *check, const fm_loop *loop,
                            fm_error *err)
{
    size_t index;
    if (loop->last == NULL)
        return fm_fail(err, FM_INVALID, "last: missing");
    fm_status status = check_known(&r->first, loop->first, "first", &check->passes, err);
    if (status == FM_OK)
        status = check_known(&r->last, loop->last, "last", &check->passes, err);
    if (status != FM_OK)
        return status;
    if (r->first > r->last)
        return fm_fail(err, FM_INVALID, "last: '%s' stands before '%s'", loop->last, loop->first);
    if (loop->count_option != NULL)
        status = check_counting_option(check, loop->count_option, "count_option", err);
    if (status != FM_OK)
        return status;
    if (loop->until_zero != NULL)
        return check_known(&index, loop->until_zero, "until_zero", &check->totals, err);
    if (!loop_is_counted(loop) && !is_ended_by_hook(check->method, r))
        return fm_fail(err, FM_INVALID,
                       "no end: needs count, until_zero, or a host pass and the after hook");
    return FM_OK;
}

static bool is_inside(const range *a, const range *b)
{
    return b->first <= a->first && a->last <= b->last;
}

static bool overlap(const range *a, const range *b)
{
    const bool are_apart = a->last < b->first || b->last < a->first;
    const bool are_same = a->first == b->first && a->last == b->last;
    const bool are_nested = is_inside(a, b) || is_inside(b, a);
    return !are_apart && (are_same || !are_nested);
}

static bool is_stepping(const fm_pass *pass)
{
    return pass->state.stencil_reference_step != 0 || pass->state.sample_mask_step != 0;
}

/* Pipelines of a pass whose state steps, one an iteration, are built before the frame: the
 * innermost loop around it says how many. */
static fm_status check_steps(const fm_checked_method *check, const range *ranges, size_t count,
                             fm_error *err)
{
    for (size_t pass = 0; pass < check->passes.count; pass++) {
        size_t innermost = count;
        for (size_t i = 0; i < count && is_stepping(&check->method->passes[pass]); i++)
            if (ranges[i].first <= pass && pass <= ranges[i].last &&
                (innermost == count || is_inside(&ranges[i], &ranges[innermost])))
                innermost = i;
        if (innermost == count)
            continue;
        const fm_loop *loop = &check->method->loops[innermost];
        if (!loop_is_counted(loop) || loop->until_zero != NULL)
            return fm_fail(err, FM_INVALID,
                           "loop '%s': stencil_reference_step, sample_mask_step of pass '%s': need "
                           "a loop of known count",
                           loop->first, check->passes.items[pass]);
    }
    return FM_OK;
}

static size_t loop_count(const fm_method_desc *method)
{
    size_t count = 0;
    while (count < FM_MAX_LOOPS && method->loops[count].first != NULL)
        count++;
    return count;
}

fm_status check_loops(const fm_checked_method *check, fm_error *err)
{
    range ranges[FM_MAX_LOOPS] = { 0 };
    const fm_loop *loops = check->method->loops;
    const size_t count = loop_count(check->method);
    for (size_t i = count; i < FM_MAX_LOOPS; i++)
        if (loops[i].first != NULL || loops[i].last != NULL)
            return fm_fail(err, FM_INVALID, "loops[%zu]: first is missing, here or before", i);
    for (size_t i = 0; i < count; i++) {
        if (check_loop(&ranges[i], check, &loops[i], err) != FM_OK)
            return fm_error_prefix(err, "loop '%s'", loops[i].first);
        for (size_t j = 0; j < i; j++)
            if (overlap(&ranges[i], &ranges[j]))
                return fm_fail(err, FM_INVALID,
                               "loop '%s': overlaps loop '%s' and is not inside it", loops[i].first,
                               loops[j].first);
    }
    return check_steps(check, ranges, count, err);
}
