#include <inttypes.h>

#include "frame_internal.h"
#include "model/formula.h"

enum { LOOP_MAX_DEFAULT = 65536 }; /* fm_loop.max */

/* The widest loop that starts with this pass and, if it runs inside a loop that starts there too,
 * is narrower than that one. */
static const fm_loop *loop_from(const fm_instance *instance, size_t first, const fm_loop *inside)
{
    const fm_method_desc *method = instance->method;
    const bool is_at_start = inside != NULL && pass_index(method, inside->first) == (int)first;
    const int end = is_at_start ? pass_index(method, inside->last) : FM_MAX_PASSES;
    const fm_loop *widest = NULL;
    int widest_last = -1;
    for (int i = 0; i < FM_MAX_LOOPS && method->loops[i].first != NULL; i++) {
        const int last = pass_index(method, method->loops[i].last);
        if (pass_index(method, method->loops[i].first) == (int)first && last < end &&
            last > widest_last) {
            widest = &method->loops[i];
            widest_last = last;
        }
    }
    return widest;
}

/* What ends a loop. */
typedef struct loop_end {
    bool is_counted;     /* never more than `count` iterations */
    uint32_t count, max; /* iterations */
    bool is_ours;        /* the method has no max of its own */
    int total;           /* until it is zero; -1: none. Neither: the hook says */
} loop_end;

static loop_end end_of(const fm_instance *instance, const fm_loop *loop)
{
    return (loop_end){
        .is_counted = loop_is_counted(loop),
        .count = formula_count(loop, &instance->workload),
        .max = loop->max > 0 ? loop->max : LOOP_MAX_DEFAULT,
        .is_ours = loop->max == 0,
        .total = total_index(instance->method, loop->until_zero),
    };
}

/* Does iteration i run? next is what the one before it answered. */
static bool goes_on(const fm_instance *instance, const loop_end *end, uint32_t i, fm_next next)
{
    if (i >= end->max || next == FM_REDO)
        return false;
    if (next == FM_REPEAT)
        return true;
    if (end->is_counted && i >= end->count)
        return false;
    if (end->total < 0)
        return end->is_counted || i == 0;
    return i == 0 || instance->totals[end->total] != 0;
}

static fm_status swap_copies(frame_run *frame)
{
    frame->instance->parity ^= 1u;
    for (size_t i = 0; i < frame->instance->resource_count; i++) {
        if (!frame->instance->resources[i][1].by_address)
            continue;
        fm_status status = frame_flush(frame);
        return status == FM_OK ? table_upload(frame->instance, frame->err) : status;
    }
    return FM_OK;
}

/* A loop that the method wanted to go on is not done. */
static fm_status judge_end(const frame_run *frame, const loop_end *end, uint32_t iterations)
{
    const fm_instance *instance = frame->instance;
    if (!end->is_ours || end->is_counted || end->total < 0 || iterations < end->max ||
        instance->totals[end->total] == 0)
        return FM_OK;
    return fm_refuse(frame->err, FM_REASON_SUITE_LIMIT,
                     "%s: total '%s' is still %" PRIu64 " after %u iterations",
                     instance->method->id, instance->method->totals[end->total].name,
                     instance->totals[end->total], iterations);
}

static fm_status run_loop(frame_run *frame, const fm_loop *loop, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const size_t first = (size_t)pass_index(instance->method, loop->first);
    const size_t last = (size_t)pass_index(instance->method, loop->last);
    const loop_end end = end_of(instance, loop);
    fm_status status = FM_OK;
    *next = FM_NEXT;
    uint32_t i = 0;
    for (; status == FM_OK && goes_on(instance, &end, i, *next); i++) {
        status = frame_range(frame, first, last, i, loop, next);
        if (status == FM_OK)
            status = swap_copies(frame);
    }
    if (status == FM_OK)
        status = judge_end(frame, &end, i);
    if (status == FM_OK && *next == FM_REPEAT)
        return fm_fail(frame->err, FM_INVALID,
                       "%s: loop '%s': after: answered FM_REPEAT (%u) in iteration %u, the last",
                       instance->method->id, loop->first, (unsigned)*next, i);
    return status;
}

fm_status frame_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
                      const fm_loop *inside, fm_next *next)
{
    fm_status status = FM_OK;
    *next = FM_NEXT;
    for (size_t i = first; i <= last && status == FM_OK && *next != FM_REDO; i++) {
        const fm_loop *loop = loop_from(frame->instance, i, inside);
        if (loop != NULL) {
            status = run_loop(frame, loop, next);
            i = (size_t)pass_index(frame->instance->method, loop->last);
            continue;
        }
        fm_next here = FM_NEXT;
        status = frame_pass(frame, i, iteration);
        if (status == FM_OK)
            status = frame_after_pass(frame, i, &here);
        if (here != FM_NEXT)
            *next = here;
    }
    return status;
}
