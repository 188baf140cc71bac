/* Running a frame: passes in order, loops, totals read back, what has to grow. */
#include "instance_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/clock.h"

enum {
    CANARY_TIMER = FM_MAX_TIMERS - 1,
    COMBINE_TIMER = FM_MAX_TIMERS - 2,
    SPAN_TIMER = FM_MAX_TIMERS - 3,
    REDO_MAX = 8,
    LOOP_MAX_DEFAULT = 65536
};
_Static_assert((int)SPAN_TIMER >= (int)FM_MAX_PASSES, "a timer for each pass");

/* A frame on its way. */
typedef struct frame_run {
    fm_instance *instance;
    fm_frame_result *result;
    fm_band band;
    fm_params params;
    bool params_are_set;
    bool is_recording;
    bool is_in_span;
    bool redo;
    uint64_t query[FM_MAX_QUERIES];
    fm_error *err;
} frame_run;

/* timers=frame: one timer from the first pass of a recording to its end; the recordings that a
 * total's read-back parts add up. */
static void pass_timer_begin(frame_run *frame, uint32_t timer)
{
    fm_device *device = frame->instance->device;
    const bool is_span = frame->instance->desc.settings->timers == FM_TIMERS_FRAME;
    if (frame->is_in_span)
        return;
    frame->is_in_span = is_span;
    device->ops->timer_begin(device, is_span ? SPAN_TIMER : timer);
}

static void pass_timer_end(frame_run *frame, uint32_t timer)
{
    fm_device *device = frame->instance->device;
    if (!frame->is_in_span)
        device->ops->timer_end(device, timer);
}

static void span_end(frame_run *frame)
{
    fm_device *device = frame->instance->device;
    if (frame->is_in_span)
        device->ops->timer_end(device, SPAN_TIMER);
    frame->is_in_span = false;
}

static fm_status flush(frame_run *frame)
{
    fm_frame_times times;
    fm_device *device = frame->instance->device;
    if (!frame->is_recording)
        return FM_OK;
    frame->is_recording = false;
    span_end(frame);
    fm_status status = device->ops->frame_end(device, &times, frame->err);
    if (status != FM_OK)
        return status;
    for (size_t i = 0; i < frame->instance->pass_count; i++)
        frame->result->pass_ns[i] += times.timer_ns[i];
    for (size_t i = 0; i < frame->instance->pass_count && frame->instance->emits_back; i++)
        if (strcmp(frame->instance->method->passes[i].name, "resolve") == 0)
            frame->result->pass_ns[i] += times.timer_ns[COMBINE_TIMER];
    frame->result->span_ns += times.timer_ns[SPAN_TIMER];
    frame->result->canary_ns += times.timer_ns[CANARY_TIMER];
    memcpy(frame->query, times.query, sizeof frame->query);
    return FM_OK;
}

static fm_status record(frame_run *frame)
{
    if (frame->is_recording)
        return FM_OK;
    fm_device *device = frame->instance->device;
    fm_status status = device->ops->frame_begin(device, frame->err);
    frame->is_recording = status == FM_OK;
    return status;
}

static void set_params(frame_run *frame, uint32_t iteration, uint32_t units)
{
    const fm_params params = { .iteration = iteration,
                               .band_first = frame->band.first,
                               .band_pixels = frame->band.pixels,
                               .units = units };
    if (frame->params_are_set && memcmp(&params, &frame->params, sizeof params) == 0)
        return;
    frame->params = params;
    frame->params_are_set = true;
    frame->instance->device->ops->update(
        frame->instance->device, frame->instance->desc.stage->params, 0, &params, sizeof params);
}

/* ---- one pass ---- */

static fm_status run_pass(frame_run *frame, size_t index, uint32_t iteration)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    const bool is_total = pass->kind == FM_PASS_TOTAL;
    if (pass_is_left_out(instance, pass))
        return FM_OK;
    fm_status status = record(frame);
    if (status != FM_OK || pass->kind == FM_PASS_HOST)
        return status;
    frame->result->scene_passes += pass->kind == FM_PASS_SCENE && pass->cover == FM_COVER_NONE;
    set_params(frame, iteration, is_total ? (uint32_t)pass_units(instance, pass) : 0);
    pass_timer_begin(frame, (uint32_t)index);
    status = pass_issue(instance, index, iteration, frame->err);
    pass_timer_end(frame, (uint32_t)index);
    return status;
}

/* ---- totals ---- */

static fm_status sum_elements(uint64_t *sum, frame_run *frame, const fm_slot *slot)
{
    fm_device *device = frame->instance->device;
    uint32_t *words = malloc(slot->length * sizeof *words);
    *sum = 0;
    if (words == NULL)
        return fm_fail(frame->err, FM_NO_MEMORY, "reading '%s' back", slot->name);
    fm_status status = device->ops->buffer_read(device, slot->buffer, 0, words,
                                                slot->length * sizeof *words, frame->err);
    for (uint64_t i = 0; i < slot->length && status == FM_OK; i++)
        *sum += words[i];
    free(words);
    return status;
}

static fm_status read_total(frame_run *frame, size_t index)
{
    fm_instance *instance = frame->instance;
    const fm_total *total = &instance->method->totals[index];
    if (total->resource == NULL) {
        instance->totals[index] = frame->query[pass_index(instance->method, total->pass)];
        return FM_OK;
    }
    const fm_slot *slot = resource_slot(instance, resource_find(instance->method, total->resource));
    uint32_t word = 0;
    if (total->sum)
        return sum_elements(&instance->totals[index], frame, slot);
    fm_status status = instance->device->ops->buffer_read(
        instance->device, slot->buffer, total->index * sizeof word, &word, sizeof word, frame->err);
    instance->totals[index] = word;
    return status;
}

/* Pipelines name how each buffer is reached; growing past the bound range changes that. */
static fm_status rebuild(frame_run *frame)
{
    passes_destroy(frame->instance);
    return passes_create(frame->instance, frame->err);
}

static uint32_t address_bits(const fm_instance *instance)
{
    uint32_t bits = 0;
    for (size_t i = 0; i < instance->resource_count; i++)
        bits |= (uint32_t)instance->resources[i][0].by_address << i;
    return bits;
}

/* Whether the frame goes on with what the total sized before, until its end. */
static bool waits(const fm_instance *instance, size_t total)
{
    return instance->method->totals[total].late && resources_are_there(instance, total);
}

static fm_status take_total(frame_run *frame, size_t index)
{
    const uint32_t before = address_bits(frame->instance);
    const bool was_used = waits(frame->instance, index);
    bool was_created = false, grew = false;
    fm_status status = read_total(frame, index);
    if (status == FM_OK)
        status = resources_create_after(&was_created, frame->instance, index, frame->err);
    if (status == FM_OK)
        status = resources_grow(&grew, frame->instance, index, frame->err);
    frame->redo = frame->redo || grew || (was_used && was_created);
    if (status == FM_OK && address_bits(frame->instance) != before)
        status = rebuild(frame);
    return status;
}

/* Totals that frames did not wait for. */
static fm_status take_late_totals(frame_run *frame)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < frame->instance->total_count && status == FM_OK; i++)
        if (frame->instance->method->totals[i].late)
            status = take_total(frame, i);
    return status;
}

/* Totals that this pass completes; the hook, if it is a host pass. */
static fm_status after_pass(frame_run *frame, size_t index, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->total_count && status == FM_OK; i++) {
        if (strcmp(instance->method->totals[i].pass, pass->name) != 0 || waits(instance, i))
            continue;
        status = flush(frame);
        if (status == FM_OK)
            status = take_total(frame, i);
    }
    *next = frame->redo ? FM_REDO : FM_NEXT;
    if (status != FM_OK || frame->redo || pass->kind != FM_PASS_HOST ||
        instance->method->after == NULL)
        return status;
    status = flush(frame);
    if (status == FM_OK)
        *next = instance->method->after(&instance->workload, pass->name);
    return status;
}

/* ---- loops ---- */

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
    int total;           /* until it is zero; -1: none. Neither: the hook says */
} loop_end;

static loop_end end_of(const fm_instance *instance, const fm_loop *loop)
{
    return (loop_end){
        .is_counted = loop_is_counted(loop),
        .count = formula_count(loop, &instance->workload),
        .max = loop->max > 0 ? loop->max : LOOP_MAX_DEFAULT,
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
        fm_status status = flush(frame);
        return status == FM_OK ? table_upload(frame->instance, frame->err) : status;
    }
    return FM_OK;
}

static fm_status run_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
                           const fm_loop *inside, fm_next *next);

static fm_status run_loop(frame_run *frame, const fm_loop *loop, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const size_t first = (size_t)pass_index(instance->method, loop->first);
    const size_t last = (size_t)pass_index(instance->method, loop->last);
    const loop_end end = end_of(instance, loop);
    fm_status status = FM_OK;
    *next = FM_NEXT;
    for (uint32_t i = 0; status == FM_OK && goes_on(instance, &end, i, *next); i++) {
        status = run_range(frame, first, last, i, loop, next);
        if (status == FM_OK)
            status = swap_copies(frame);
    }
    if (*next == FM_REPEAT) /* heard: it is not for the loop around this one */
        *next = FM_NEXT;
    return status;
}

static fm_status run_range(frame_run *frame, size_t first, size_t last, uint32_t iteration,
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
        status = run_pass(frame, i, iteration);
        if (status == FM_OK)
            status = after_pass(frame, i, &here);
        if (here != FM_NEXT)
            *next = here;
    }
    return status;
}

/* ---- a frame ---- */

uint64_t frame_passes_ns(const fm_frame_result *result)
{
    uint64_t sum = result->span_ns;
    for (size_t i = 0; i < FM_MAX_PASSES; i++)
        sum += result->pass_ns[i];
    return sum;
}

static fm_status start(frame_run *frame)
{
    fm_instance *instance = frame->instance;
    fm_device *device = instance->device;
    fm_status status = FM_OK;
    if (instance->desc.settings->pool == FM_POOL_PER_FRAME) {
        resources_destroy(instance); /* as published: each frame asks for its memory anew */
        status = resources_create_fixed(instance, frame->err);
    }
    /* The last frame is the timed one; of those thrown away the sum is kept. */
    frame->result->redone_ns += frame_passes_ns(frame->result);
    memset(frame->result->pass_ns, 0, sizeof frame->result->pass_ns);
    frame->result->span_ns = 0;
    frame->result->canary_ns = 0;
    frame->result->scene_passes = 0;
    frame->redo = false;
    frame->params_are_set = false;
    instance->parity = 0;
    if (status == FM_OK)
        status = record(frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0);
    if (instance->desc.is_capture)
        device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    device->ops->timer_begin(device, CANARY_TIMER);
    device->ops->timer_end(device, CANARY_TIMER);
    return FM_OK;
}

static fm_status combine(frame_run *frame)
{
    fm_instance *instance = frame->instance;
    static const fm_pass pass = { .kind = FM_PASS_PIXELS };
    if (instance->combine.use_count == 0)
        return FM_OK;
    fm_status status = record(frame);
    if (status != FM_OK)
        return status;
    pass_timer_begin(frame, COMBINE_TIMER);
    status = pass_dispatch(instance, &pass, &instance->combine, pass_invocations(instance, &pass),
                           frame->err);
    pass_timer_end(frame, COMBINE_TIMER);
    return status;
}

static fm_status run_once(frame_run *frame)
{
    fm_next next = FM_NEXT;
    fm_status status = start(frame);
    if (status == FM_OK)
        status = run_range(frame, 0, frame->instance->pass_count - 1, 0, NULL, &next);
    if (status == FM_OK && next != FM_REDO)
        status = combine(frame);
    frame->redo = next == FM_REDO;
    /* After an error the frame that is open must still be ended. */
    fm_error ignored;
    fm_error *err = frame->err;
    frame->err = status == FM_OK ? err : &ignored;
    const fm_status ended = flush(frame);
    frame->err = err;
    if (status == FM_OK)
        status = ended;
    return status == FM_OK && !frame->redo ? take_late_totals(frame) : status;
}

static fm_status read_counters(frame_run *frame)
{
    uint32_t words[STAGE_COUNTER_COUNT] = { 0 };
    fm_instance *instance = frame->instance;
    fm_status status = instance->device->ops->buffer_read(
        instance->device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0, words,
        sizeof words, frame->err);
    frame->result->lost = words[STAGE_COUNTER_LOST];
    frame->result->culled = words[STAGE_COUNTER_CULLED];
    frame->result->locked = words[STAGE_COUNTER_LOCKED];
    frame->result->arrived = words[STAGE_COUNTER_ARRIVED];
    return status;
}

fm_status instance_frame(fm_frame_result *result, fm_instance *instance, const fm_band *band,
                         fm_error *err)
{
    frame_run frame = { .instance = instance, .result = result, .err = err };
    *result = (fm_frame_result){ 0 };
    if (band != NULL)
        frame.band = *band;
    const uint64_t started_ns = clock_ns();
    fm_status status = run_once(&frame);
    while (status == FM_OK && frame.redo) {
        if (++result->redos > REDO_MAX)
            return fm_fail(err, FM_INVALID, "%s: asked for the frame again %d times",
                           instance->method->id, REDO_MAX);
        status = run_once(&frame);
    }
    result->wall_ns = clock_ns() - started_ns;
    return status == FM_OK ? read_counters(&frame) : status;
}

bool instance_can_emit_again(const fm_instance *instance)
{
    return instance->method->loops[0].first == NULL;
}

bool instance_may_give_up(const fm_instance *instance)
{
    return instance->is_spin_locked && instance->device->caps.is_software;
}

fm_status instance_emit(fm_instance *instance, const fm_band *band, fm_error *err)
{
    fm_frame_result result = { 0 };
    frame_run frame = { .instance = instance, .result = &result, .band = *band, .err = err };
    fm_device *device = instance->device;
    fm_status status = record(&frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    for (size_t i = 0; i < instance->pass_count && status == FM_OK; i++)
        if (instance->method->passes[i].emits)
            status = run_pass(&frame, i, 0);
    const fm_status ended = flush(&frame);
    return status == FM_OK ? ended : status;
}
