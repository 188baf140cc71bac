/* Loops of a descriptor: ranges of passes that nest and end. */
#include "plugin_check.h"

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

/* Its pipelines, one an iteration, are built before the frame. */
static bool has_stepping_state(const fm_method_desc *method, const range *r)
{
    for (size_t i = r->first; i <= r->last; i++)
        if (method->passes[i].state.stencil_reference_step != 0 ||
            method->passes[i].state.sample_mask_step != 0)
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
    const bool is_counted = loop->count > 0 || loop->count_per_k > 0 || loop->count_per_n > 0;
    if ((!is_counted || loop->until_zero != NULL) && has_stepping_state(check->method, r))
        return fm_fail(err, FM_INVALID,
                       "stencil_reference_step, sample_mask_step: need a loop of known count");
    if (loop->until_zero != NULL)
        return check_known(&index, loop->until_zero, "until_zero", &check->totals, err);
    if (!is_counted && !is_ended_by_hook(check->method, r))
        return fm_fail(err, FM_INVALID,
                       "no end: needs count, until_zero, or a host pass and the after hook");
    return FM_OK;
}

static bool overlap(const range *a, const range *b)
{
    const bool are_apart = a->last < b->first || b->last < a->first;
    const bool are_same = a->first == b->first && a->last == b->last;
    const bool are_nested = (a->first <= b->first && b->last <= a->last) ||
                            (b->first <= a->first && a->last <= b->last);
    return !are_apart && (are_same || !are_nested);
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
    return FM_OK;
}
