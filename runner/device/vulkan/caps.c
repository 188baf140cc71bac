#include <stdio.h>
#include <string.h>

#include "context.h"

/* llvmpipe ends all loops of an invocation after LP_MAX_TGSI_LOOP_ITERATIONS, without a word, and
 * no image is larger than LP_MAX_TEXTURE_SIZE, which nothing reports. */
enum { LAVAPIPE_LOOP_LIMIT = 65535, LAVAPIPE_IMAGE_BYTES = 1 << 30 };

static uint64_t device_local_bytes(const VkPhysicalDeviceMemoryProperties *memory)
{
    uint64_t bytes = 0;
    for (uint32_t i = 0; i < memory->memoryHeapCount; i++) {
        if ((memory->memoryHeaps[i].flags & VK_MEMORY_HEAP_DEVICE_LOCAL_BIT) != 0 &&
            memory->memoryHeaps[i].size > bytes)
            bytes = memory->memoryHeaps[i].size;
    }
    return bytes;
}

static char *add_uuid(char *at, const uint8_t uuid[VK_UUID_SIZE])
{
    for (size_t i = 0; i < VK_UUID_SIZE; i++)
        at += sprintf(at, "%02x", uuid[i]);
    return at;
}

/* The cache's UUID differs where compiled shaders may; the other parts are for drivers that keep
 * it. */
static void describe_build(char build[sizeof((fm_device_caps *)NULL)->driver_build],
                           const VkPhysicalDeviceProperties *core,
                           const VkPhysicalDeviceVulkan11Properties *core11,
                           const VkPhysicalDeviceVulkan12Properties *core12)
{
    char *at = add_uuid(build, core->pipelineCacheUUID);
    *at++ = ' ';
    at = add_uuid(at, core11->driverUUID);
    sprintf(at, " %d %08x %04x:%04x", (int)core12->driverID, core->driverVersion, core->vendorID,
            core->deviceID);
}

static void describe(vulkan *self, const VkPhysicalDeviceProperties *core,
                     const VkPhysicalDeviceVulkan11Properties *core11,
                     const VkPhysicalDeviceVulkan12Properties *core12)
{
    fm_device_caps *caps = &self->base.caps;
    snprintf(caps->name, sizeof caps->name, "%.127s", core->deviceName);
    snprintf(caps->driver, sizeof caps->driver, "%.63s %.63s", core12->driverName,
             core12->driverInfo);
    describe_build(caps->driver_build, core, core11, core12);
    snprintf(caps->api, sizeof caps->api, "Vulkan %u.%u.%u", VK_API_VERSION_MAJOR(core->apiVersion),
             VK_API_VERSION_MINOR(core->apiVersion), VK_API_VERSION_PATCH(core->apiVersion));
}

/* Of those that shaders store into. */
static uint64_t largest_image(VkPhysicalDevice physical, uint64_t largest_allocation)
{
    VkImageFormatProperties limits;
    const VkImageUsageFlags usage =
        vulkan_format_usage(FM_FORMAT_RG32UI) | VK_IMAGE_USAGE_STORAGE_BIT;
    if (!vulkan_format_limits(&limits, physical, FM_FORMAT_RG32UI, usage))
        return largest_allocation;
    return limits.maxResourceSize < largest_allocation ? limits.maxResourceSize
                                                       : largest_allocation;
}

static void set_limits(vulkan *self, const VkPhysicalDeviceLimits *limits,
                       const VkPhysicalDeviceVulkan11Properties *core11,
                       const VkPhysicalDeviceVulkan13Properties *core13)
{
    fm_device_caps *caps = &self->base.caps;
    self->limits = *limits;
    caps->subgroup_size = core11->subgroupSize;
    caps->colour_samples = vulkan_format_samples(self->physical, FM_FORMAT_R32UI, FM_FORMAT_RGBA8);
    caps->depth_samples = vulkan_format_samples(self->physical, FM_FORMAT_D32F, FM_FORMAT_D32F_S8);
    caps->max_targets =
        limits->maxColorAttachments < FM_MAX_TARGETS ? limits->maxColorAttachments : FM_MAX_TARGETS;
    caps->storage_range_bytes = limits->maxStorageBufferRange;
    caps->buffer_max_bytes = core13->maxBufferSize < core11->maxMemoryAllocationSize
                                 ? core13->maxBufferSize
                                 : core11->maxMemoryAllocationSize;
    caps->image_layers = limits->maxImageArrayLayers;
    caps->image_max_bytes = largest_image(self->physical, core11->maxMemoryAllocationSize);
    caps->memory_bytes = device_local_bytes(&self->memory);
    memcpy(caps->max_groups, limits->maxComputeWorkGroupCount, sizeof caps->max_groups);
}

static void set_timestamps(vulkan *self)
{
    VkQueueFamilyProperties families[32];
    uint32_t count = 32;
    vkGetPhysicalDeviceQueueFamilyProperties(self->physical, &count, families);
    const uint32_t bits = families[self->queue_family].timestampValidBits;
    self->timestamp_mask = bits >= 64 ? ~0ull : (1ull << bits) - 1;
    self->base.caps.timestamp_ns = bits > 0 ? (double)self->limits.timestampPeriod : 0.0;
    self->no_timers = self->no_timers || bits == 0;
}

void vulkan_caps_find(vulkan *self)
{
    fm_device_caps *caps = &self->base.caps;
    VkPhysicalDeviceVulkan13Properties core13 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_PROPERTIES
    };
    VkPhysicalDeviceVulkan12Properties core12 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_PROPERTIES, .pNext = &core13
    };
    VkPhysicalDeviceVulkan11Properties core11 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES, .pNext = &core12
    };
    VkPhysicalDeviceProperties2 core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                         .pNext = &core11 };
    vkGetPhysicalDeviceProperties2(self->physical, &core);
    vkGetPhysicalDeviceMemoryProperties(self->physical, &self->memory);
    const VkPhysicalDeviceType type = core.properties.deviceType;
    const bool is_lavapipe = core12.driverID == VK_DRIVER_ID_MESA_LLVMPIPE;
    describe(self, &core.properties, &core11, &core12);
    set_limits(self, &core.properties.limits, &core11, &core13);
    set_timestamps(self);
    caps->is_software = type == VK_PHYSICAL_DEVICE_TYPE_CPU;
    caps->has_gpu_clock = type == VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU ||
                          type == VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU;
    /* lavapipe masks helper lanes off before atomics; it cannot compile gl_HelperInvocation, and
     * memory barriers in divergent compute code break it. */
    caps->needs_helper_guard = !is_lavapipe;
    caps->needs_lock_barriers = !is_lavapipe;
    caps->counts_accesses = true;
    caps->loop_limit = is_lavapipe ? LAVAPIPE_LOOP_LIMIT : 0;
    if (is_lavapipe && caps->image_max_bytes > LAVAPIPE_IMAGE_BYTES)
        caps->image_max_bytes = LAVAPIPE_IMAGE_BYTES;
}
