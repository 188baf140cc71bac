#include <assert.h>
#include <stdlib.h>

#include "context.h"
#include "device/ledger.h"

#define NEAR_GPU     VK_MEMORY_PROPERTY_DEVICE_LOCAL_BIT
#define HOST_VISIBLE (VK_MEMORY_PROPERTY_HOST_VISIBLE_BIT | VK_MEMORY_PROPERTY_HOST_COHERENT_BIT)
#define HOST_CACHED  VK_MEMORY_PROPERTY_HOST_CACHED_BIT

/* What each kind of memory should be, best first. Counters lie in a GPU's own memory also where the
 * host cannot reach it: else their atomics would cross the bus. */
static const struct {
    VkMemoryPropertyFlags wishes[3];
    size_t count;
} kinds[] = {
    [VULKAN_MEMORY_DEVICE] = { { NEAR_GPU, 0 }, 2 },
    [VULKAN_MEMORY_COUNTERS] = { { NEAR_GPU | HOST_VISIBLE | HOST_CACHED, NEAR_GPU | HOST_VISIBLE,
                                   NEAR_GPU },
                                 3 },
    [VULKAN_MEMORY_STAGING] = { { HOST_VISIBLE | HOST_CACHED, HOST_VISIBLE }, 2 },
};

/* The first allowed type with all of `wanted`; UINT32_MAX: none. */
static uint32_t find_type(const vulkan *self, uint32_t allowed, VkMemoryPropertyFlags wanted)
{
    for (uint32_t i = 0; i < self->memory.memoryTypeCount; i++) {
        if ((allowed & 1u << i) != 0 &&
            (self->memory.memoryTypes[i].propertyFlags & wanted) == wanted)
            return i;
    }
    return UINT32_MAX;
}

/* The best type of this kind; UINT32_MAX: none fits. */
static uint32_t choose_type(const vulkan *self, uint32_t allowed, vulkan_memory_kind kind)
{
    uint32_t type = UINT32_MAX;
    for (size_t i = 0; i < kinds[kind].count && type == UINT32_MAX; i++)
        type = find_type(self, allowed, kinds[kind].wishes[i]);
    return type;
}

fm_status vulkan_memory_allocate(vulkan_memory *memory, const vulkan *self,
                                 const vulkan_memory_desc *desc, fm_error *err)
{
    const VkMemoryAllocateFlagsInfo flags = { .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_FLAGS_INFO,
                                              .flags = VK_MEMORY_ALLOCATE_DEVICE_ADDRESS_BIT };
    const uint32_t type = choose_type(self, desc->needs.memoryTypeBits, desc->kind);
    const VkMemoryAllocateInfo info = { .sType = VK_STRUCTURE_TYPE_MEMORY_ALLOCATE_INFO,
                                        .pNext = desc->has_address ? &flags : NULL,
                                        .allocationSize = desc->needs.size,
                                        .memoryTypeIndex = type };
    *memory = (vulkan_memory){ .memory = VK_NULL_HANDLE };
    if (type == UINT32_MAX)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT, "no memory type fits");
    const VkResult result = vkAllocateMemory(self->device, &info, NULL, &memory->memory);
    if (result != VK_SUCCESS) {
        memory->memory = VK_NULL_HANDLE;
        return vulkan_fail(err, result, "no room for %llu bytes",
                           (unsigned long long)desc->needs.size);
    }
    const VkMemoryPropertyFlags has = self->memory.memoryTypes[type].propertyFlags;
    memory->can_map = (has & HOST_VISIBLE) == HOST_VISIBLE;
    memory->is_cached = (has & HOST_CACHED) != 0;
    return FM_OK;
}

enum { STAGING_BYTES = 16 << 20 };

/* How a buffer of this folder is made. */
typedef struct buffer_plan {
    uint64_t bytes;
    fm_owner owner;
    VkBufferUsageFlags usage;
    vulkan_memory_kind kind;
    bool is_mapped; /* if its memory can be */
} buffer_plan;

static fm_status map(fm_buffer *buffer, const vulkan *self, const vulkan_memory *memory,
                     fm_error *err)
{
    buffer->is_cached = memory->is_cached;
    if (!memory->can_map)
        return FM_OK;
    const VkResult result =
        vkMapMemory(self->device, buffer->memory, 0, VK_WHOLE_SIZE, 0, &buffer->mapped);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "mapping");
}

static fm_status back_with_memory(fm_buffer *buffer, const vulkan *self, const buffer_plan *plan,
                                  fm_error *err)
{
    const bool has_address = (plan->usage & VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT) != 0;
    vulkan_memory_desc desc = { .kind = plan->kind, .has_address = has_address };
    vulkan_memory memory;
    vkGetBufferMemoryRequirements(self->device, buffer->buffer, &desc.needs);
    const fm_status status = vulkan_memory_allocate(&memory, self, &desc, err);
    if (status != FM_OK)
        return status;
    buffer->memory = memory.memory;
    const VkResult result = vkBindBufferMemory(self->device, buffer->buffer, buffer->memory, 0);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "binding memory");
    if (has_address)
        buffer->address = vkGetBufferDeviceAddress(
            self->device,
            &(VkBufferDeviceAddressInfo){ .sType = VK_STRUCTURE_TYPE_BUFFER_DEVICE_ADDRESS_INFO,
                                          .buffer = buffer->buffer });
    return plan->is_mapped ? map(buffer, self, &memory, err) : FM_OK;
}

static void release(const vulkan *self, fm_buffer *buffer)
{
    if (buffer != NULL && !self->has_hung) {
        vkDestroyBuffer(self->device, buffer->buffer, NULL);
        vkFreeMemory(self->device, buffer->memory, NULL);
    }
    free(buffer);
}

static fm_status create(fm_buffer **buffer, const vulkan *self, const buffer_plan *plan,
                        fm_error *err)
{
    fm_status status = FM_OK;
    const VkBufferCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_BUFFER_CREATE_INFO,
        .size = (plan->bytes + 3) & ~3ull, /* so that a fill reaches the last byte */
        .usage = plan->usage,
    };
    fm_buffer *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%zu bytes", sizeof *made);
    made->bytes = plan->bytes;
    made->owner = plan->owner;
    const VkResult result = vkCreateBuffer(self->device, &info, NULL, &made->buffer);
    if (result != VK_SUCCESS) {
        made->buffer = VK_NULL_HANDLE;
        status = vulkan_fail(err, result, "%llu bytes", (unsigned long long)plan->bytes);
        goto out;
    }
    status = back_with_memory(made, self, plan, err);
    if (status != FM_OK)
        goto out;
    *buffer = made;
    made = NULL;
out:
    release(self, made);
    return status;
}

fm_status vulkan_staging_create(fm_buffer **staging, const vulkan *self, fm_error *err)
{
    const buffer_plan plan = {
        .bytes = STAGING_BYTES,
        .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT,
        .kind = VULKAN_MEMORY_STAGING,
        .is_mapped = true,
    };
    const fm_status status = create(staging, self, &plan, err);
    if (status != FM_OK && err != NULL)
        fm_error_prefix(err, "vulkan: staging buffer");
    return status;
}

void vulkan_staging_destroy(const vulkan *self, fm_buffer *staging)
{
    release(self, staging);
}

static fm_status check_limit(const fm_buffer_desc *desc, uint64_t limit, const char *which,
                             fm_error *err)
{
    if (desc->bytes <= limit)
        return FM_OK;
    return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                     "buffer '%s': %llu bytes, %s buffers of this device end at %llu", desc->name,
                     (unsigned long long)desc->bytes, which, (unsigned long long)limit);
}

static fm_status check_size(const vulkan *self, const fm_buffer_desc *desc, fm_error *err)
{
    const fm_device_caps *caps = &self->base.caps;
    assert(desc->bytes > 0);
    if (desc->by_address && (caps->features & FM_FEATURE_BUFFER_ADDRESS) == 0)
        return fm_refuse(err, FM_REASON_FEATURE, "buffer '%s': this device has no buffer addresses",
                         desc->name);
    if (desc->by_address)
        return check_limit(desc, caps->buffer_max_bytes, "addressed", err);
    if (desc->is_uniform)
        return check_limit(desc, self->limits.maxUniformBufferRange, "uniform", err);
    return check_limit(desc, caps->storage_range_bytes, "bound", err);
}

static VkBufferUsageFlags usage_of(const fm_buffer_desc *desc)
{
    VkBufferUsageFlags usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT |
                               VK_BUFFER_USAGE_TRANSFER_SRC_BIT | VK_BUFFER_USAGE_TRANSFER_DST_BIT;
    if (desc->is_vertex)
        usage |= VK_BUFFER_USAGE_VERTEX_BUFFER_BIT;
    if (desc->is_index)
        usage |= VK_BUFFER_USAGE_INDEX_BUFFER_BIT;
    if (desc->is_uniform)
        usage |= VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT;
    if (desc->is_indirect)
        usage |= VK_BUFFER_USAGE_INDIRECT_BUFFER_BIT;
    if (desc->by_address)
        usage |= VK_BUFFER_USAGE_SHADER_DEVICE_ADDRESS_BIT;
    return usage;
}

fm_status vulkan_buffer_create(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               fm_error *err)
{
    vulkan *self = (vulkan *)device;
    const buffer_plan plan = {
        .bytes = desc->bytes,
        .owner = desc->owner,
        .usage = usage_of(desc),
        .kind = desc->host_reads ? VULKAN_MEMORY_COUNTERS : VULKAN_MEMORY_DEVICE,
        .is_mapped = desc->host_reads,
    };
    *buffer = NULL;
    fm_status status = check_size(self, desc, err);
    if (status != FM_OK)
        return status;
    status = create(buffer, self, &plan, err);
    if (status == FM_OK)
        ledger_add(&device->ledger, desc->owner, desc->bytes);
    else if (err != NULL)
        fm_error_prefix(err, "buffer '%s'", desc->name);
    return status;
}

void vulkan_buffer_destroy(fm_device *device, fm_buffer *buffer)
{
    if (buffer == NULL)
        return;
    ledger_remove(&device->ledger, buffer->owner, buffer->bytes);
    release((vulkan *)device, buffer);
}

uint64_t vulkan_buffer_address(const fm_buffer *buffer)
{
    return buffer->address;
}
