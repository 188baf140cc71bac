#include <string.h>

#include "context.h"

/* Feature structs in one chain, to be asked for and to be enabled. */
typedef struct feature_chain {
    VkPhysicalDeviceFeatures2 core;
    VkPhysicalDeviceVulkan12Features core12;
    VkPhysicalDeviceVulkan13Features core13;
    VkPhysicalDeviceFragmentShaderInterlockFeaturesEXT interlock;
} feature_chain;

static void chain_begin(feature_chain *chain, bool has_interlock)
{
    *chain = (feature_chain){
        .core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FEATURES_2, .pNext = &chain->core12 },
        .core12 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_2_FEATURES,
                    .pNext = &chain->core13 },
        .core13 = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_3_FEATURES,
                    .pNext = has_interlock ? &chain->interlock : NULL },
        .interlock = { .sType =
                           VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_FRAGMENT_SHADER_INTERLOCK_FEATURES_EXT },
    };
}

/* Enables what shaders and passes here may use, where the device has it. Not all it has: some
 * features (robust access) cost time. */
static void choose_features(feature_chain *use, const feature_chain *has)
{
    use->core.features = (VkPhysicalDeviceFeatures){
        .independentBlend = has->core.features.independentBlend,
        .geometryShader = has->core.features.geometryShader, /* gl_PrimitiveID */
        .sampleRateShading = has->core.features.sampleRateShading,
        .occlusionQueryPrecise = has->core.features.occlusionQueryPrecise,
        .vertexPipelineStoresAndAtomics = has->core.features.vertexPipelineStoresAndAtomics,
        .fragmentStoresAndAtomics = has->core.features.fragmentStoresAndAtomics,
        .shaderStorageImageExtendedFormats = has->core.features.shaderStorageImageExtendedFormats,
        .shaderStorageImageMultisample = has->core.features.shaderStorageImageMultisample,
        .shaderInt64 = has->core.features.shaderInt64,
    };
    use->core12.shaderBufferInt64Atomics = has->core12.shaderBufferInt64Atomics;
    use->core12.bufferDeviceAddress = has->core12.bufferDeviceAddress;
    use->core12.hostQueryReset = has->core12.hostQueryReset;
    use->core12.vulkanMemoryModel = has->core12.vulkanMemoryModel;
    use->core12.vulkanMemoryModelDeviceScope = has->core12.vulkanMemoryModelDeviceScope;
    use->core13.dynamicRendering = has->core13.dynamicRendering;
    use->core13.synchronization2 = has->core13.synchronization2;
    use->core13.maintenance4 = has->core13.maintenance4;
    use->core13.shaderDemoteToHelperInvocation = has->core13.shaderDemoteToHelperInvocation;
    use->core13.shaderTerminateInvocation = has->core13.shaderTerminateInvocation; /* discard */
    use->interlock.fragmentShaderPixelInterlock = has->interlock.fragmentShaderPixelInterlock;
    use->interlock.fragmentShaderSampleInterlock = has->interlock.fragmentShaderSampleInterlock;
}

static bool has_extension(const VkExtensionProperties *extensions, uint32_t count, const char *name)
{
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(extensions[i].extensionName, name) == 0)
            return true;
    }
    return false;
}

typedef struct extension_choice {
    const char *names[2];
    uint32_t count;
    bool has_interlock, has_stencil_export;
} extension_choice;

static void choose_extensions(extension_choice *choice, VkPhysicalDevice physical)
{
    VkExtensionProperties extensions[512];
    uint32_t count = 512;
    *choice = (extension_choice){ .count = 0 };
    if (vkEnumerateDeviceExtensionProperties(physical, NULL, &count, extensions) < 0)
        return;
    choice->has_interlock =
        has_extension(extensions, count, VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME);
    choice->has_stencil_export =
        has_extension(extensions, count, VK_EXT_SHADER_STENCIL_EXPORT_EXTENSION_NAME);
    if (choice->has_interlock)
        choice->names[choice->count++] = VK_EXT_FRAGMENT_SHADER_INTERLOCK_EXTENSION_NAME;
    if (choice->has_stencil_export)
        choice->names[choice->count++] = VK_EXT_SHADER_STENCIL_EXPORT_EXTENSION_NAME;
}

/* Whether fragment and compute shaders can vote. */
static bool has_ballot(VkPhysicalDevice physical)
{
    const VkShaderStageFlags stages = VK_SHADER_STAGE_FRAGMENT_BIT | VK_SHADER_STAGE_COMPUTE_BIT;
    VkPhysicalDeviceVulkan11Properties core11 = {
        .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_VULKAN_1_1_PROPERTIES
    };
    VkPhysicalDeviceProperties2 core = { .sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2,
                                         .pNext = &core11 };
    vkGetPhysicalDeviceProperties2(physical, &core);
    return (core11.subgroupSupportedOperations & VK_SUBGROUP_FEATURE_BALLOT_BIT) != 0 &&
           (core11.subgroupSupportedStages & stages) == stages;
}

static uint32_t feature_bits(const feature_chain *use, const extension_choice *extensions,
                             VkPhysicalDevice physical)
{
    uint32_t bits = 0;
    if (use->core.features.shaderInt64 && use->core12.shaderBufferInt64Atomics)
        bits |= FM_FEATURE_INT64_ATOMICS;
    if (use->interlock.fragmentShaderPixelInterlock)
        bits |= FM_FEATURE_INTERLOCK;
    if (extensions->has_stencil_export)
        bits |= FM_FEATURE_STENCIL_EXPORT;
    if (use->core12.bufferDeviceAddress)
        bits |= FM_FEATURE_BUFFER_ADDRESS;
    if (has_ballot(physical))
        bits |= FM_FEATURE_SUBGROUP_BALLOT;
    return bits;
}

fm_status vulkan_logical_device_create(vulkan *self, fm_error *err)
{
    static const float priority = 1.0f;
    extension_choice extensions;
    feature_chain has, use;
    choose_extensions(&extensions, self->physical);
    chain_begin(&has, extensions.has_interlock);
    chain_begin(&use, extensions.has_interlock);
    vkGetPhysicalDeviceFeatures2(self->physical, &has.core);
    choose_features(&use, &has);
    self->base.caps.features = feature_bits(&use, &extensions, self->physical);
    self->base.caps.has_memory_model =
        use.core12.vulkanMemoryModel && use.core12.vulkanMemoryModelDeviceScope;
    if (!use.core12.bufferDeviceAddress)
        self->base.caps.buffer_max_bytes = 0;
    self->can_store_multisampled = use.core.features.shaderStorageImageMultisample;
    self->can_query_precisely = use.core.features.occlusionQueryPrecise;
    if (!use.core12.hostQueryReset || !use.core.features.fragmentStoresAndAtomics)
        return fm_refuse(err, FM_REASON_FEATURE,
                         "vulkan: '%s' lacks hostQueryReset or fragmentStoresAndAtomics",
                         self->base.caps.name);
    const VkDeviceQueueCreateInfo queue = { .sType = VK_STRUCTURE_TYPE_DEVICE_QUEUE_CREATE_INFO,
                                            .queueFamilyIndex = self->queue_family,
                                            .queueCount = 1,
                                            .pQueuePriorities = &priority };
    const VkDeviceCreateInfo info = { .sType = VK_STRUCTURE_TYPE_DEVICE_CREATE_INFO,
                                      .pNext = &use.core,
                                      .queueCreateInfoCount = 1,
                                      .pQueueCreateInfos = &queue,
                                      .enabledExtensionCount = extensions.count,
                                      .ppEnabledExtensionNames = extensions.names };
    const VkResult result = vkCreateDevice(self->physical, &info, NULL, &self->device);
    if (result != VK_SUCCESS) {
        self->device = VK_NULL_HANDLE;
        if (result == VK_ERROR_INITIALIZATION_FAILED) /* another day it may work */
            return fm_fail(err, FM_IO, "vulkan: '%s' cannot be opened", self->base.caps.name);
        return vulkan_fail(err, result, "vulkan: opening '%s'", self->base.caps.name);
    }
    vkGetDeviceQueue(self->device, self->queue_family, 0, &self->queue);
    return FM_OK;
}
