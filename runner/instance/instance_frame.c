#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "frame_internal.h"

enum { REDO_MAX = 8 }; /* tries of a frame in which something grows */

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
    frame->gone_on = 0;
    instance->parity = 0;
    if (status == FM_OK)
        status = frame_record(frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0);
    if (instance->desc.is_capture)
        device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    counts_begin(instance);
    device->ops->timer_begin(device, CANARY_TIMER);
    device->ops->timer_end(device, CANARY_TIMER);
    return FM_OK;
}

static fm_status combine(frame_run *frame)
{
    fm_instance *instance = frame->instance;
    if (instance->combine.use_count == 0)
        return FM_OK;
    fm_status status = frame_record(frame);
    if (status != FM_OK)
        return status;
    frame_timer_begin(frame, COMBINE_TIMER);
    status = pass_dispatch(instance, &instance_combine, &instance->combine,
                           pass_invocations(instance, &instance_combine), frame->err);
    frame_timer_end(frame, COMBINE_TIMER);
    return status;
}

static fm_status run_once(frame_run *frame)
{
    fm_next next = FM_NEXT;
    frame->hook_redoes = false;
    fm_status status = start(frame);
    if (status == FM_OK)
        status = frame_range(frame, 0, frame->instance->pass_count - 1, 0, NULL, &next);
    if (status == FM_OK && next != FM_REDO)
        status = combine(frame);
    frame->redo = next == FM_REDO;
    /* After an error the frame that is open must still be ended. */
    fm_error ignored;
    fm_error *err = frame->err;
    frame->err = status == FM_OK ? err : &ignored;
    const fm_status ended = frame_flush(frame);
    frame->err = err;
    if (status == FM_OK)
        status = ended;
    return status == FM_OK && !frame->redo ? frame_late_totals(frame) : status;
}

fm_status instance_cut(const fm_instance *instance, uint32_t cut, fm_error *err)
{
    const fm_workload *workload = &instance->workload;
    char k[24] = "";
    if (workload->k > 0)
        snprintf(k, sizeof k, ", k = %u", workload->k);
    for (size_t i = 0; i < instance->pass_count; i++)
        if ((cut >> i & 1u) != 0)
            return fm_refuse(err, FM_REASON_LOOPS,
                             "n = %u%s: the loops of pass '%s' need more than the %u iterations "
                             "after which this driver ends them",
                             workload->n, k, instance->method->passes[i].name,
                             instance->device->caps.loop_limit);
    return FM_OK;
}

static uint32_t exclusive_passes(const fm_instance *instance)
{
    uint32_t bits = 0;
    for (size_t i = 0; i < instance->pass_count; i++)
        bits |= (uint32_t)instance->method->passes[i].exclusive << i;
    return bits;
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
    frame->result->repaired = words[STAGE_COUNTER_REPAIRED];
    frame->result->unrepaired = words[STAGE_COUNTER_UNREPAIRED];
    frame->result->arrived = words[STAGE_COUNTER_ARRIVED];
    frame->result->cut = words[STAGE_COUNTER_CUT];
    if (status == FM_OK)
        status =
            instance_cut(instance, frame->result->cut & ~exclusive_passes(instance), frame->err);
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
            return fm_fail(err, FM_INVALID, "%s: asked for the frame again %d times%s",
                           instance->method->id, REDO_MAX,
                           frame.hook_redoes ? "; after: answered FM_REDO (2)" : "");
        status = run_once(&frame);
    }
    result->wall_ns = clock_ns() - started_ns;
    if (status == FM_OK)
        status = read_counters(&frame);
    return status == FM_OK ? counts_read(instance, err) : status;
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
    fm_status status = frame_record(&frame);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, instance->desc.stage->slots[STAGE_CAPTURE_COUNTS].buffer, 0);
    device->ops->fill(device, instance->desc.stage->slots[STAGE_COUNTERS].buffer, 0);
    for (size_t i = 0; i < instance->pass_count && status == FM_OK; i++)
        if (instance->method->passes[i].emits)
            status = frame_pass(&frame, i, 0);
    /* After an error the frame that is open must still be ended, and the first error stays. */
    fm_error ignored;
    frame.err = status == FM_OK ? err : &ignored;
    const fm_status ended = frame_flush(&frame);
    if (status == FM_OK)
        status = ended;
    return status == FM_OK ? read_counters(&frame) : status;
}

fm_status instance_image_hash(uint64_t *hash, fm_instance *instance, fm_error *err)
{
    fm_device *device = instance->device;
    fm_buffer *counters = instance->desc.stage->slots[STAGE_COUNTERS].buffer;
    uint32_t words[STAGE_COUNTER_COUNT] = { 0 };
    fm_frame_times times;
    fm_status status = device->ops->frame_begin(device, err);
    if (status != FM_OK)
        return status;
    device->ops->fill(device, counters, 0);
    status = pass_dispatch(instance, &instance_hash, &instance->hash,
                           pass_invocations(instance, &instance_hash), err);
    /* After an error the frame that is open must still be ended, and the first error stays. */
    fm_error ignored;
    const fm_status ended =
        device->ops->frame_end(device, &times, status == FM_OK ? err : &ignored);
    if (status == FM_OK)
        status = ended;
    if (status == FM_OK)
        status = device->ops->buffer_read(device, counters, 0, words, sizeof words, err);
    *hash = (uint64_t)words[STAGE_COUNTER_IMAGE_HIGH] << 32 | words[STAGE_COUNTER_IMAGE_LOW];
    return status;
}
