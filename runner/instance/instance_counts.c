/* What the shaders of a frame do with the method's memory, counted: which resources, where the
 * device adds the numbers up, and the numbers. */
#include <string.h>

#include "instance_internal.h"
#include "model/formats.h"

/* Both copies of each resource, and the locks. */
enum { COUNTED = 2 * FM_MAX_RESOURCES + 1, LOCKS = COUNTED - 1, NOT_BOUND = UINT32_MAX };

fm_status counts_create(fm_instance *instance, fm_error *err)
{
    const fm_buffer_desc desc = { .name = "fm_accesses",
                                  .bytes = SPIRV_COUNTER_WORDS(COUNTED) * sizeof(uint32_t),
                                  .owner = FM_OWNER_RUNNER,
                                  .host_reads = true };
    if (!instance->desc.counts_accesses || !instance->device->caps.counts_accesses)
        return FM_OK;
    return instance->device->ops->buffer_create(&instance->counters, instance->device, &desc, err);
}

/* One line of the table holds address and length of a buffer. */
static spirv_resource counted_resource(const fm_use *use)
{
    const fm_slot *slot = use->slot;
    return (spirv_resource){
        .binding = use->binding,
        .by_address = slot->by_address,
        .address_offset = slot->table_index * SHADER_TABLE_STRIDE,
        .length_offset =
            slot->table_index * SHADER_TABLE_STRIDE + (uint32_t)offsetof(fm_table_line, length),
        .texel_bytes = slot->format == FM_FORMAT_NONE ? 0 : format_bytes(slot->format),
    };
}

bool counts_describe(pass_counting *counting, const fm_instance *instance, const built_pass *built)
{
    if (instance->counters == NULL || instance->uncounted[0] != '\0')
        return false;
    for (uint32_t i = 0; i < COUNTED; i++)
        counting->resources[i] = (spirv_resource){ .binding = NOT_BOUND };
    for (size_t i = 0; i < built->use_count; i++) {
        const resource_ref ref = built->refs[i];
        if (ref.index >= 0)
            counting->resources[2 * ref.index + ref.is_previous] =
                counted_resource(&built->uses[i]);
        else if (built->uses[i].slot == &instance->locks)
            counting->resources[LOCKS] = counted_resource(&built->uses[i]);
    }
    counting->desc = (spirv_counting){ .resources = counting->resources,
                                       .resource_count = COUNTED,
                                       .table_binding = SHADER_BINDING_TABLE,
                                       .counters_binding = counts_binding(built) };
    return true;
}

void counts_begin(fm_instance *instance)
{
    memset(instance->filled, 0, sizeof instance->filled);
    if (instance->counters != NULL)
        instance->device->ops->fill(instance->device, instance->counters, 0);
}

void counts_add_fill(fm_instance *instance, size_t index)
{
    const fm_resource *resource = &instance->method->resources[index];
    const fm_slot *slot = resource_slot(instance, (resource_ref){ .index = (int)index });
    const uint64_t texels = (uint64_t)instance->workload.width_px * instance->workload.height_px *
                            slot->layers * slot->samples;
    instance->filled[index] += resource->kind == FM_RESOURCE_IMAGE
                                   ? texels * format_bytes(slot->format)
                                   : slot->length * element_bytes(resource->element);
}

static void add(fm_accesses *to, uint32_t words[SPIRV_COUNT_KINDS][2])
{
    uint64_t counts[SPIRV_COUNT_KINDS];
    for (int i = 0; i < SPIRV_COUNT_KINDS; i++)
        counts[i] = (uint64_t)words[i][1] << 32 | words[i][0];
    to->loaded += counts[SPIRV_LOADED];
    to->stored += counts[SPIRV_STORED];
    to->atomics += counts[SPIRV_ATOMICS];
    to->outside += counts[SPIRV_OUTSIDE];
}

fm_status counts_read(fm_instance *instance, fm_error *err)
{
    uint32_t words[COUNTED][SPIRV_COUNT_KINDS][2];
    memset(instance->accesses, 0, sizeof instance->accesses);
    if (instance->counters == NULL)
        return FM_OK;
    const fm_status status = instance->device->ops->buffer_read(
        instance->device, instance->counters, 0, words, sizeof words, err);
    for (size_t i = 0; i < instance->resource_count && status == FM_OK; i++) {
        instance->accesses[i].stored = instance->filled[i];
        add(&instance->accesses[i], words[2 * i]);
        add(&instance->accesses[i], words[2 * i + 1]);
    }
    if (status == FM_OK)
        add(&instance->accesses[instance->resource_count], words[LOCKS]);
    return status;
}

bool instance_accesses(fm_accesses *accesses, const char **name, const fm_instance *instance,
                       size_t index)
{
    const bool is_locks = index == instance->resource_count;
    if (instance->counters == NULL || instance->uncounted[0] != '\0' ||
        index > instance->resource_count)
        return false;
    *accesses = instance->accesses[index];
    *name = is_locks ? instance->locks.name : instance->method->resources[index].name;
    return true;
}

const char *instance_uncounted(const fm_instance *instance)
{
    return instance->uncounted;
}
