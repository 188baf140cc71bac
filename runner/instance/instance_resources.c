#include "instance_internal.h"
#include "model/formats.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

/* Some GPUs let the host see little of their memory. */
enum { HOST_READ_BYTES_MAX = 16 << 20 };

static const char previous_suffix[] = "_previous";

resource_ref resource_find(const fm_method_desc *method, const char *name)
{
    size_t length = strlen(name);
    const size_t suffix = sizeof previous_suffix - 1;
    resource_ref ref = { .index = -1 };
    ref.is_previous = length > suffix && strcmp(name + length - suffix, previous_suffix) == 0;
    if (ref.is_previous)
        length -= suffix;
    for (int i = 0; i < FM_MAX_RESOURCES && method->resources[i].name != NULL; i++)
        if (strlen(method->resources[i].name) == length &&
            memcmp(method->resources[i].name, name, length) == 0)
            ref.index = i;
    return ref;
}

int pass_index(const fm_method_desc *method, const char *name)
{
    for (int i = 0; name != NULL && i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (strcmp(method->passes[i].name, name) == 0)
            return i;
    return -1;
}

uint64_t resource_elements(const fm_instance *instance, size_t index)
{
    return formula_sum(formula_elements(instance->method,
                                        &instance->method->resources[index].extent,
                                        &instance->workload),
                       instance->grown[index]);
}

static fm_status create_buffer(fm_instance *instance, fm_slot *slot, const fm_resource *resource,
                               uint64_t elements, fm_error *err)
{
    const uint64_t length = elements > 0 ? elements : 1; /* an empty scene still binds something */
    const uint32_t stride = element_bytes(resource->element);
    const uint64_t shared = formula_buffer_bytes(instance->method, resource, &instance->workload);
    if (length > (UINT64_MAX >> 1) / stride || shared > UINT64_MAX >> 1)
        return fm_fail(err, FM_NO_MEMORY, "buffer '%s': its extent is over 2^63 bytes",
                       resource->name);
    const uint64_t own = length * stride; /* grown, perhaps, beyond the extent */
    const fm_buffer_desc desc = { .name = resource->name,
                                  .bytes = own > shared ? own : shared,
                                  .owner = FM_OWNER_METHOD,
                                  .is_indirect = true,
                                  .host_reads =
                                      resource->extent.constant > 0 && own <= HOST_READ_BYTES_MAX };
    slot->length = length;
    return slot_create_buffer(slot, instance->device, instance->desc.settings->buffers, &desc, err);
}

uint32_t resource_samples(const fm_instance *instance, const fm_resource *resource)
{
    return formula_samples(resource, &instance->workload);
}

static fm_status create_image(fm_instance *instance, fm_slot *slot, const fm_resource *resource,
                              fm_error *err)
{
    slot->format = resource->format;
    slot->samples = resource_samples(instance, resource);
    slot->layers = formula_layers(resource, &instance->workload);
    slot->is_array = image_is_array(resource);
    const fm_image_desc desc = { .name = resource->name,
                                 .format = slot->format,
                                 .width_px = instance->workload.width_px,
                                 .height_px = instance->workload.height_px,
                                 .layers = slot->layers,
                                 .is_array = slot->is_array,
                                 .samples = slot->samples,
                                 .owner = FM_OWNER_METHOD };
    return instance->device->ops->image_create(&slot->image, instance->device, &desc, err);
}

/* Buffers that lie in the memory of this one. */
static void link_sharers(fm_instance *instance, size_t index)
{
    const fm_slot *owner = &instance->resources[index][0];
    for (size_t i = 0; i < instance->resource_count; i++) {
        const fm_resource *resource = &instance->method->resources[i];
        fm_slot *slot = &instance->resources[i][0];
        if (resource->shares == NULL || strcmp(resource->shares, owner->name) != 0)
            continue;
        const uint64_t elements = resource_elements(instance, i);
        slot->length = elements > 0 ? elements : 1;
        slot->buffer = owner->buffer;
        slot->by_address = owner->by_address;
    }
}

static fm_status create_resource(fm_instance *instance, size_t index, fm_error *err)
{
    const fm_resource *resource = &instance->method->resources[index];
    const int copies = resource->ping_pong ? 2 : 1;
    fm_status status = FM_OK;
    if (resource->shares != NULL)
        return FM_OK; /* when its owner is */
    for (int copy = 0; copy < copies && status == FM_OK; copy++) {
        fm_slot *slot = &instance->resources[index][copy];
        slot_destroy(slot, instance->device);
        status =
            resource->kind == FM_RESOURCE_IMAGE
                ? create_image(instance, slot, resource, err)
                : create_buffer(instance, slot, resource, resource_elements(instance, index), err);
    }
    link_sharers(instance, index);
    return status;
}

static fm_status create_locks(fm_instance *instance, fm_error *err)
{
    const fm_buffer_desc desc = { .name = "fm_locks",
                                  .bytes = lock_bytes(instance),
                                  .owner = FM_OWNER_METHOD };
    slot_destroy(&instance->locks, instance->device);
    instance->locks.length = desc.bytes / sizeof(uint32_t);
    fm_status status = slot_create_buffer(&instance->locks, instance->device,
                                          instance->desc.settings->buffers, &desc, err);
    fm_frame_times times;
    if (status != FM_OK)
        return status;
    /* Filled once: locks are free between frames. */
    status = instance->device->ops->frame_begin(instance->device, err);
    if (status == FM_OK)
        instance->device->ops->fill(instance->device, instance->locks.buffer, 0);
    return status == FM_OK ? instance->device->ops->frame_end(instance->device, &times, err)
                           : status;
}

fm_status resources_create_fixed(fm_instance *instance, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->resource_count && status == FM_OK; i++)
        if (instance->method->resources[i].sizing != FM_SIZE_AFTER_TOTAL)
            status = create_resource(instance, i, err);
    if (status == FM_OK && lock_bytes(instance) > 0)
        status = create_locks(instance, err);
    return status == FM_OK ? table_upload(instance, err) : status;
}

static bool is_sized_by(const fm_instance *instance, size_t index, size_t total)
{
    const fm_resource *resource = &instance->method->resources[index];
    return resource->sizing == FM_SIZE_AFTER_TOTAL &&
           strcmp(resource->extent.total, instance->method->totals[total].name) == 0;
}

fm_status resources_create_after(bool *was_created, fm_instance *instance, size_t total,
                                 fm_error *err)
{
    fm_status status = FM_OK;
    *was_created = false;
    for (size_t i = 0; i < instance->resource_count && status == FM_OK; i++) {
        const fm_slot *slot = &instance->resources[i][0];
        if (!is_sized_by(instance, i, total) ||
            (slot->buffer != NULL && slot->length >= resource_elements(instance, i)))
            continue;
        status = create_resource(instance, i, err);
        *was_created = true;
    }
    return status == FM_OK && *was_created ? table_upload(instance, err) : status;
}

bool resources_are_there(const fm_instance *instance, size_t total)
{
    for (size_t i = 0; i < instance->resource_count; i++)
        if (is_sized_by(instance, i, total) && instance->resources[i][0].buffer == NULL)
            return false;
    return true;
}

fm_status resources_grow(bool *grew, fm_instance *instance, size_t total, fm_error *err)
{
    const char *name = instance->method->totals[total].name;
    fm_status status = FM_OK;
    *grew = false;
    for (size_t i = 0; i < instance->resource_count && status == FM_OK; i++) {
        const fm_resource *resource = &instance->method->resources[i];
        if (resource->sizing != FM_SIZE_GROW || strcmp(resource->overflow, name) != 0 ||
            instance->totals[total] == 0)
            continue;
        instance->grown[i] = formula_sum(instance->grown[i], instance->totals[total]);
        *grew = true;
        status = create_resource(instance, i, err);
    }
    return status == FM_OK && *grew ? table_upload(instance, err) : status;
}

void resources_destroy(fm_instance *instance)
{
    for (size_t i = 0; i < instance->resource_count; i++) {
        if (instance->method->resources[i].shares != NULL)
            instance->resources[i][0].buffer = NULL;
        for (int copy = 0; copy < 2; copy++)
            slot_destroy(&instance->resources[i][copy], instance->device);
    }
    slot_destroy(&instance->locks, instance->device);
}

static void table_line(fm_table_line *line, const fm_instance *instance, const fm_slot *slot)
{
    if (slot->buffer == NULL)
        return;
    line->length = slot->length < UINT32_MAX ? (uint32_t)slot->length : UINT32_MAX;
    if (slot->by_address)
        line->address = instance->device->ops->buffer_address(slot->buffer);
}

fm_status table_upload(fm_instance *instance, fm_error *err)
{
    fm_table_line lines[SHADER_TABLE_LINES] = { 0 };
    const fm_slot *shared = instance->desc.stage->slots;
    for (int i = 0; i < STAGE_SLOT_COUNT; i++)
        table_line(&lines[shared[i].table_index], instance, &shared[i]);
    for (size_t i = 0; i < instance->resource_count; i++) {
        const fm_slot *copies = instance->resources[i];
        const uint32_t written = copies[1].buffer != NULL ? instance->parity : 0;
        table_line(&lines[copies[0].table_index], instance, &copies[written]);
        if (copies[1].buffer != NULL) /* what the last iteration wrote */
            table_line(&lines[copies[1].table_index], instance, &copies[1 - written]);
    }
    table_line(&lines[instance->locks.table_index], instance, &instance->locks);
    return instance->device->ops->buffer_write(instance->device, instance->table, 0, lines,
                                               sizeof lines, err);
}
