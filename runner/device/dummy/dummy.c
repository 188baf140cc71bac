#include "dummy.h"

#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "device/ledger.h"
#include "model/formats.h"

enum { DUMMY_RANGE_BYTES = 1 << 30 };

typedef enum dummy_fault {
    FAULT_NONE,
    FAULT_LOST,
    FAULT_TINY,
    FAULT_OUT_OF_MEMORY,
    FAULT_COUNT
} dummy_fault;

static const char *const fault_name[] = {
    [FAULT_NONE] = "",
    [FAULT_LOST] = "lost",
    [FAULT_TINY] = "tiny",
    [FAULT_OUT_OF_MEMORY] = "out-of-memory",
};
_Static_assert(sizeof fault_name / sizeof fault_name[0] == FAULT_COUNT, "one name a fault");

struct fm_buffer {
    unsigned char *bytes;
    uint64_t count;
    fm_owner owner;
    bool by_address;
};

struct fm_image_resource {
    uint64_t bytes; /* booked; there are none */
    fm_owner owner;
};

struct fm_pipeline {
    bool is_compute;
};

typedef struct dummy {
    fm_device base;
    dummy_fault fault;
    bool no_timers;
    dummy_counts counts;
    uint64_t clock_ns, frame_start_ns, timer_start_ns;
    fm_frame_times times;
} dummy;

static fm_status list_devices(fm_device_entry *entries, size_t *count, fm_error *err)
{
    (void)err;
    if (*count > 0) {
        snprintf(entries[0].selector, sizeof entries[0].selector, "dummy");
        snprintf(entries[0].name, sizeof entries[0].name, "nothing is drawn; for tests");
        *count = 1;
    }
    return FM_OK;
}

static fm_status find_fault(dummy_fault *fault, const char *selector, fm_error *err)
{
    const char *wanted = selector != NULL ? selector : "";
    for (size_t i = 0; i < FAULT_COUNT; i++) {
        if (strcmp(wanted, fault_name[i]) == 0) {
            *fault = (dummy_fault)i;
            return FM_OK;
        }
    }
    const char *nearest = text_nearest(wanted, fault_name + 1, FAULT_COUNT - 1);
    return fm_fail(err, FM_INVALID, "dummy:%s: no such fault; the nearest is 'dummy:%s'", wanted,
                   nearest != NULL ? nearest : fault_name[FAULT_LOST]);
}

static void fill_caps(fm_device_caps *caps, dummy_fault fault)
{
    *caps = (fm_device_caps){
        .name = "dummy",
        .driver = "fragmark",
        .api = "none",
        .features = FM_FEATURES_ALL,
        .is_software = true,
        .subgroup_size = 32,
        .colour_samples = 1u << 1 | 1u << 2 | 1u << 4 | 1u << 8,
        .depth_samples = 1u << 1 | 1u << 2 | 1u << 4 | 1u << 8,
        .max_targets = FM_MAX_TARGETS,
        .storage_range_bytes = fault == FAULT_TINY ? DUMMY_TINY_BYTES : DUMMY_RANGE_BYTES,
        .buffer_max_bytes = DUMMY_RANGE_BYTES,
        .image_layers = 2048,
        .image_max_bytes = DUMMY_RANGE_BYTES,
        .memory_bytes = 4ull * DUMMY_RANGE_BYTES,
        .max_groups = { 65535, 65535, 65535 },
        .timestamp_ns = 1.0,
    };
}

static fm_status open_device(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    dummy_fault fault = FAULT_NONE;
    *device = NULL;
    const fm_status status = find_fault(&fault, desc->selector, err);
    if (status != FM_OK)
        return status;
    dummy *self = calloc(1, sizeof *self);
    if (self == NULL)
        return fm_fail(err, FM_NO_MEMORY, "dummy: %zu bytes", sizeof *self);
    self->base.ops = &dummy_device;
    self->fault = fault;
    self->no_timers = desc->no_timers;
    fill_caps(&self->base.caps, fault);
    *device = &self->base;
    return FM_OK;
}

static void close_device(fm_device *device)
{
    free(device);
}

static uint32_t validation_errors(const fm_device *device, const char **first)
{
    (void)device;
    *first = "";
    return 0;
}

static fm_status check_buffer(const dummy *self, const fm_buffer_desc *desc, fm_error *err)
{
    const uint64_t range =
        desc->by_address ? self->base.caps.buffer_max_bytes : self->base.caps.storage_range_bytes;
    assert(desc->bytes > 0);
    if (desc->bytes > range)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "buffer '%s': %llu bytes, %s buffers of this device end at %llu bytes",
                         desc->name, (unsigned long long)desc->bytes,
                         desc->by_address ? "addressed" : "bound", (unsigned long long)range);
    if (self->fault == FAULT_OUT_OF_MEMORY)
        return fm_fail(err, FM_NO_MEMORY, "buffer '%s': no room for %llu bytes", desc->name,
                       (unsigned long long)desc->bytes);
    return FM_OK;
}

static fm_status buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err)
{
    fm_status status = check_buffer((const dummy *)device, desc, err);
    *buffer = NULL;
    if (status != FM_OK)
        return status;
    fm_buffer *made = calloc(1, sizeof *made);
    if (made != NULL)
        made->bytes = calloc(1, desc->bytes);
    if (made == NULL || made->bytes == NULL) {
        free(made);
        return fm_fail(err, FM_NO_MEMORY, "buffer '%s': no room for %llu bytes", desc->name,
                       (unsigned long long)desc->bytes);
    }
    made->count = desc->bytes;
    made->owner = desc->owner;
    made->by_address = desc->by_address;
    ledger_add(&device->ledger, made->owner, made->count);
    *buffer = made;
    return FM_OK;
}

static void buffer_destroy(fm_device *device, fm_buffer *buffer)
{
    if (buffer == NULL)
        return;
    ledger_remove(&device->ledger, buffer->owner, buffer->count);
    free(buffer->bytes);
    free(buffer);
}

static uint64_t buffer_address(const fm_buffer *buffer)
{
    return buffer->by_address ? (uint64_t)(uintptr_t)buffer->bytes : 0;
}

static fm_status buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err)
{
    (void)device, (void)err;
    assert(offset_bytes <= buffer->count && count <= buffer->count - offset_bytes);
    if (count > 0)
        memcpy(buffer->bytes + offset_bytes, bytes, count);
    return FM_OK;
}

static fm_status buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err)
{
    (void)device, (void)err;
    assert(offset_bytes <= buffer->count && count <= buffer->count - offset_bytes);
    if (count > 0)
        memcpy(bytes, buffer->bytes + offset_bytes, count);
    return FM_OK;
}

static fm_status image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err)
{
    const uint32_t layers = desc->layers == 0 ? 1 : desc->layers;
    const uint32_t samples = desc->samples == 0 ? 1 : desc->samples;
    *image = NULL;
    if (samples >= 32 || (device->caps.colour_samples >> samples & 1u) == 0)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u samples are not possible on this device", desc->name,
                         samples);
    fm_image_resource *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "image '%s': its handle", desc->name);
    made->bytes =
        (uint64_t)desc->width_px * desc->height_px * layers * samples * format_bytes(desc->format);
    made->owner = desc->owner;
    ledger_add(&device->ledger, made->owner, made->bytes);
    *image = made;
    return FM_OK;
}

static void image_destroy(fm_device *device, fm_image_resource *image)
{
    if (image == NULL)
        return;
    ledger_remove(&device->ledger, image->owner, image->bytes);
    free(image);
}

static fm_status check_source(const char *source, const char *pipeline, const char *stage,
                              fm_error *err)
{
    const char *fault = source != NULL ? strstr(source, "#error") : NULL;
    unsigned line = 1;
    if (fault == NULL)
        return FM_OK;
    for (const char *at = source; at < fault; at++)
        line += *at == '\n';
    return fm_fail(err, FM_SHADER, "%s: %s shader, line %u: '%.*s'", pipeline, stage, line,
                   (int)strcspn(fault, "\n"), fault);
}

static fm_status pipeline_create(fm_pipeline **pipeline, fm_device *device,
                                 const fm_pipeline_desc *desc, fm_error *err)
{
    (void)device;
    *pipeline = NULL;
    fm_status status = check_source(desc->compute, desc->name, "compute", err);
    if (status == FM_OK)
        status = check_source(desc->vertex, desc->name, "vertex", err);
    if (status == FM_OK)
        status = check_source(desc->fragment, desc->name, "fragment", err);
    if (status != FM_OK)
        return status;
    fm_pipeline *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: its handle", desc->name);
    made->is_compute = desc->compute != NULL;
    *pipeline = made;
    return FM_OK;
}

static void pipeline_destroy(fm_device *device, fm_pipeline *pipeline)
{
    (void)device;
    free(pipeline);
}

static fm_status frame_begin(fm_device *device, fm_error *err)
{
    dummy *self = (dummy *)device;
    (void)err;
    self->counts.frames++;
    self->times = (fm_frame_times){ .wall_ns = 0 };
    self->frame_start_ns = self->clock_ns;
    return FM_OK;
}

static fm_status frame_end(fm_device *device, fm_frame_times *times, fm_error *err)
{
    dummy *self = (dummy *)device;
    self->times.wall_ns = self->clock_ns - self->frame_start_ns;
    *times = self->times;
    if (self->fault == FAULT_LOST)
        return fm_fail(err, FM_DEVICE_LOST, "dummy: lost, as dummy:lost asks");
    return FM_OK;
}

static void timer_begin(fm_device *device, uint32_t timer)
{
    dummy *self = (dummy *)device;
    assert(timer < FM_MAX_TIMERS);
    (void)timer;
    self->timer_start_ns = self->clock_ns;
}

static void timer_end(fm_device *device, uint32_t timer)
{
    dummy *self = (dummy *)device;
    assert(timer < FM_MAX_TIMERS);
    if (self->no_timers)
        return;
    self->clock_ns += DUMMY_TIMER_NS;
    self->times.timer_ns[timer] += self->clock_ns - self->timer_start_ns;
}

static void fill(fm_device *device, fm_buffer *buffer, uint32_t word)
{
    dummy *self = (dummy *)device;
    self->counts.fills++;
    self->clock_ns += DUMMY_COMMAND_NS;
    for (uint64_t at = 0; at < buffer->count; at += sizeof word) {
        const uint64_t left = buffer->count - at;
        memcpy(buffer->bytes + at, &word, left < sizeof word ? left : sizeof word);
    }
}

static void update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count)
{
    dummy *self = (dummy *)device;
    assert(count % 4 == 0 && count <= 65536);
    assert(offset_bytes <= buffer->count && count <= buffer->count - offset_bytes);
    self->counts.updates++;
    self->clock_ns += DUMMY_COMMAND_NS;
    memcpy(buffer->bytes + offset_bytes, bytes, count);
}

static void image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil)
{
    dummy *self = (dummy *)device;
    (void)image, (void)colour, (void)depth, (void)stencil;
    self->counts.image_clears++;
    self->clock_ns += DUMMY_COMMAND_NS;
}

static void assert_binds(const fm_bind *binds, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        assert((binds[i].buffer != NULL) != (binds[i].image != NULL));
    (void)binds;
}

static fm_status dispatch(fm_device *device, const fm_dispatch *command, fm_error *err)
{
    dummy *self = (dummy *)device;
    (void)err;
    assert(command->pipeline->is_compute);
    assert_binds(command->binds, command->bind_count);
    self->counts.dispatches++;
    self->clock_ns += DUMMY_COMMAND_NS;
    return FM_OK;
}

static fm_status draw(fm_device *device, const fm_draw *command, fm_error *err)
{
    dummy *self = (dummy *)device;
    (void)err;
    assert(!command->pipeline->is_compute);
    assert_binds(command->binds, command->bind_count);
    assert(command->query < FM_MAX_QUERIES);
    self->counts.draws++;
    self->clock_ns += DUMMY_COMMAND_NS;
    return FM_OK;
}

dummy_counts dummy_counts_of(const fm_device *device)
{
    assert(device->ops == &dummy_device);
    return ((const dummy *)device)->counts;
}

const fm_device_ops dummy_device = {
    .name = "dummy",
    .list = list_devices,
    .open = open_device,
    .close = close_device,
    .validation_errors = validation_errors,
    .buffer_create = buffer_create,
    .buffer_destroy = buffer_destroy,
    .buffer_address = buffer_address,
    .buffer_write = buffer_write,
    .buffer_read = buffer_read,
    .image_create = image_create,
    .image_destroy = image_destroy,
    .pipeline_create = pipeline_create,
    .pipeline_destroy = pipeline_destroy,
    .frame_begin = frame_begin,
    .frame_end = frame_end,
    .timer_begin = timer_begin,
    .timer_end = timer_end,
    .fill = fill,
    .update = update,
    .image_clear = image_clear,
    .dispatch = dispatch,
    .draw = draw,
};
