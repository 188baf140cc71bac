#include "context.h"

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
        return fm_fail(err, FM_UNSUPPORTED, "no memory type fits");
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
