#include <string.h>

#include "frame_internal.h"

/* timers=frame: one timer from the first pass of a recording to its end; the recordings that a
 * total's read-back parts add up. */
void frame_timer_begin(frame_run *frame, uint32_t timer)
{
    fm_device *device = frame->instance->device;
    const bool is_span = frame->instance->desc.settings->timers == FM_TIMERS_FRAME;
    if (frame->is_in_span)
        return;
    frame->is_in_span = is_span;
    device->ops->timer_begin(device, is_span ? SPAN_TIMER : timer);
}

void frame_timer_end(frame_run *frame, uint32_t timer)
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

fm_status frame_flush(frame_run *frame)
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

fm_status frame_record(frame_run *frame)
{
    if (frame->is_recording)
        return FM_OK;
    fm_device *device = frame->instance->device;
    fm_status status = device->ops->frame_begin(device, frame->err);
    frame->is_recording = status == FM_OK;
    return status;
}

static void set_params(frame_run *frame, uint32_t iteration, uint32_t run, uint32_t units)
{
    const fm_params params = { .iteration = iteration,
                               .band_first = frame->band.first,
                               .band_pixels = frame->band.pixels,
                               .units = units,
                               .two = 2,
                               .run = run };
    if (frame->params_are_set && memcmp(&params, &frame->params, sizeof params) == 0)
        return;
    frame->params = params;
    frame->params_are_set = true;
    frame->instance->device->ops->update(
        frame->instance->device, frame->instance->desc.stage->params, 0, &params, sizeof params);
}

static fm_status run_pass(frame_run *frame, size_t index, uint32_t iteration, uint32_t run)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    const bool is_total = pass->kind == FM_PASS_TOTAL;
    fm_status status = frame_record(frame);
    if (status != FM_OK || pass->kind == FM_PASS_HOST)
        return status;
    set_params(frame, iteration, run, is_total ? (uint32_t)pass_units(instance, pass) : 0);
    frame_timer_begin(frame, (uint32_t)index);
    status = pass_issue(instance, index, iteration, frame->err);
    frame_timer_end(frame, (uint32_t)index);
    return status;
}

/* Whether an invocation of the run that was recorded last called fm_go_on(). */
static fm_status read_goes_on(bool *goes_on, frame_run *frame)
{
    const fm_device *device = frame->instance->device;
    uint32_t count = frame->gone_on;
    fm_status status = frame_flush(frame);
    if (status == FM_OK)
        status = device->ops->buffer_read(
            frame->instance->device, frame->instance->desc.stage->slots[STAGE_COUNTERS].buffer,
            STAGE_COUNTER_GO_ON * sizeof count, &count, sizeof count, frame->err);
    *goes_on = status == FM_OK && count != frame->gone_on;
    frame->gone_on = count;
    return status;
}

fm_status frame_pass(frame_run *frame, size_t index, uint32_t iteration)
{
    const fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    bool goes_on = !pass_is_left_out(instance, pass);
    fm_status status = FM_OK;
    frame->result->scene_passes +=
        goes_on && pass->kind == FM_PASS_SCENE && pass->cover == FM_COVER_NONE;
    for (uint32_t run = 0; goes_on && status == FM_OK; run++) {
        status = run_pass(frame, index, iteration, run);
        goes_on = false;
        if (status == FM_OK && pass_resumes(instance, pass))
            status = read_goes_on(&goes_on, frame);
    }
    return status;
}
