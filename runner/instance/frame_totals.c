#include <stdlib.h>
#include <string.h>

#include "frame_internal.h"

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

fm_status frame_late_totals(frame_run *frame)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < frame->instance->total_count && status == FM_OK; i++)
        if (frame->instance->method->totals[i].late)
            status = take_total(frame, i);
    return status;
}

fm_status frame_after_pass(frame_run *frame, size_t index, fm_next *next)
{
    fm_instance *instance = frame->instance;
    const fm_pass *pass = &instance->method->passes[index];
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->total_count && status == FM_OK; i++) {
        if (strcmp(instance->method->totals[i].pass, pass->name) != 0 || waits(instance, i))
            continue;
        status = frame_flush(frame);
        if (status == FM_OK)
            status = take_total(frame, i);
    }
    *next = frame->redo ? FM_REDO : FM_NEXT;
    if (status != FM_OK || frame->redo || pass->kind != FM_PASS_HOST ||
        instance->method->after == NULL)
        return status;
    status = frame_flush(frame);
    if (status == FM_OK)
        status = frame_hook(next, frame, index);
    frame->hook_redoes = status == FM_OK && *next == FM_REDO;
    return status;
}
