#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"

#define VALIDATION_LAYER "VK_LAYER_KHRONOS_validation"

static VkBool32 VKAPI_PTR note_message(VkDebugUtilsMessageSeverityFlagBitsEXT severity,
                                       VkDebugUtilsMessageTypeFlagsEXT types,
                                       const VkDebugUtilsMessengerCallbackDataEXT *data, void *user)
{
    vulkan_validation *validation = user;
    (void)severity, (void)types;
    if (validation->errors++ == 0)
        snprintf(validation->first, sizeof validation->first, "%s", data->pMessage);
    return VK_FALSE;
}

/* Errors only: performance warnings say nothing about right or wrong. */
static VkDebugUtilsMessengerCreateInfoEXT messenger_info(vulkan_validation *validation)
{
    return (VkDebugUtilsMessengerCreateInfoEXT){
        .sType = VK_STRUCTURE_TYPE_DEBUG_UTILS_MESSENGER_CREATE_INFO_EXT,
        .messageSeverity = VK_DEBUG_UTILS_MESSAGE_SEVERITY_ERROR_BIT_EXT,
        .messageType = VK_DEBUG_UTILS_MESSAGE_TYPE_VALIDATION_BIT_EXT,
        .pfnUserCallback = note_message,
        .pUserData = validation,
    };
}

static bool has_validation_layer(void)
{
    VkLayerProperties layers[64];
    uint32_t count = 64;
    if (vkEnumerateInstanceLayerProperties(&count, layers) < 0)
        return false;
    for (uint32_t i = 0; i < count; i++) {
        if (strcmp(layers[i].layerName, VALIDATION_LAYER) == 0)
            return true;
    }
    return false;
}

static fm_status create_messenger(VkInstance instance, vulkan_validation *validation, fm_error *err)
{
    const VkDebugUtilsMessengerCreateInfoEXT info = messenger_info(validation);
    const PFN_vkCreateDebugUtilsMessengerEXT create =
        (PFN_vkCreateDebugUtilsMessengerEXT)vkGetInstanceProcAddr(instance,
                                                                  "vkCreateDebugUtilsMessengerEXT");
    if (create == NULL)
        return fm_refuse(err, FM_REASON_DRIVER, "vulkan: the validation layer has no messages");
    const VkResult result = create(instance, &info, NULL, &validation->messenger);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "vulkan: messages");
}

static fm_status fail_instance(fm_error *err, VkResult result)
{
    const char *variable = getenv("VK_DRIVER_FILES") != NULL    ? "VK_DRIVER_FILES"
                           : getenv("VK_ICD_FILENAMES") != NULL ? "VK_ICD_FILENAMES"
                                                                : NULL;
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER && variable != NULL)
        return fm_refuse(err, FM_REASON_DRIVER,
                         "vulkan: no driver can be loaded from what %s names: %.200s", variable,
                         getenv(variable));
    if (result == VK_ERROR_INCOMPATIBLE_DRIVER)
        return fm_refuse(err, FM_REASON_DRIVER,
                         "vulkan: no driver is installed; without a GPU: apt-get install "
                         "mesa-vulkan-drivers");
    return vulkan_fail(err, result, "vulkan: creating an instance");
}

fm_status vulkan_instance_create(VkInstance *instance, vulkan_validation *validation,
                                 bool wants_validation, fm_error *err)
{
    static const char *const layers[] = { VALIDATION_LAYER };
    static const char *const extensions[] = { VK_EXT_DEBUG_UTILS_EXTENSION_NAME };
    static const VkValidationFeatureEnableEXT checks[] = {
        VK_VALIDATION_FEATURE_ENABLE_SYNCHRONIZATION_VALIDATION_EXT
    };
    const VkDebugUtilsMessengerCreateInfoEXT messenger = messenger_info(validation);
    const VkValidationFeaturesEXT features = {
        .sType = VK_STRUCTURE_TYPE_VALIDATION_FEATURES_EXT,
        .pNext = &messenger, /* for what happens while the instance is created */
        .enabledValidationFeatureCount = 1,
        .pEnabledValidationFeatures = checks,
    };
    const VkApplicationInfo application = { .sType = VK_STRUCTURE_TYPE_APPLICATION_INFO,
                                            .pApplicationName = "fragmark",
                                            .apiVersion = VK_API_VERSION_1_3 };
    VkInstanceCreateInfo info = { .sType = VK_STRUCTURE_TYPE_INSTANCE_CREATE_INFO,
                                  .pApplicationInfo = &application };
    if (wants_validation) {
        if (!has_validation_layer())
            return fm_refuse(
                err, FM_REASON_DRIVER,
                "vulkan: validation was asked for and is not installed; apt-get install "
                "vulkan-validationlayers");
        info.pNext = &features;
        info.enabledLayerCount = 1;
        info.ppEnabledLayerNames = layers;
        info.enabledExtensionCount = 1;
        info.ppEnabledExtensionNames = extensions;
    }
    const VkResult result = vkCreateInstance(&info, NULL, instance);
    if (result != VK_SUCCESS) {
        *instance = VK_NULL_HANDLE;
        return fail_instance(err, result);
    }
    return wants_validation ? create_messenger(*instance, validation, err) : FM_OK;
}

void vulkan_instance_destroy(VkInstance instance, vulkan_validation *validation)
{
    if (instance == VK_NULL_HANDLE)
        return;
    if (validation->messenger != VK_NULL_HANDLE) {
        const PFN_vkDestroyDebugUtilsMessengerEXT destroy =
            (PFN_vkDestroyDebugUtilsMessengerEXT)vkGetInstanceProcAddr(
                instance, "vkDestroyDebugUtilsMessengerEXT");
        destroy(instance, validation->messenger, NULL);
    }
    vkDestroyInstance(instance, NULL);
}

uint32_t vulkan_queue_family(VkPhysicalDevice physical)
{
    VkQueueFamilyProperties families[32];
    const VkQueueFlags wanted = VK_QUEUE_GRAPHICS_BIT | VK_QUEUE_COMPUTE_BIT;
    uint32_t count = 32;
    vkGetPhysicalDeviceQueueFamilyProperties(physical, &count, families);
    for (uint32_t i = 0; i < count; i++) {
        if ((families[i].queueFlags & wanted) == wanted)
            return i;
    }
    return UINT32_MAX;
}

static int rank(const VkPhysicalDeviceProperties *properties)
{
    switch (properties->deviceType) {
    case VK_PHYSICAL_DEVICE_TYPE_DISCRETE_GPU:
        return 0;
    case VK_PHYSICAL_DEVICE_TYPE_INTEGRATED_GPU:
        return 1;
    case VK_PHYSICAL_DEVICE_TYPE_VIRTUAL_GPU:
        return 2;
    case VK_PHYSICAL_DEVICE_TYPE_CPU:
        return 4;
    default:
        return 3;
    }
}

fm_status vulkan_find_devices(VkPhysicalDevice found[VULKAN_DEVICES_MAX], size_t *count,
                              VkInstance instance, fm_error *err)
{
    VkPhysicalDevice all[VULKAN_DEVICES_MAX];
    int ranks[VULKAN_DEVICES_MAX];
    uint32_t all_count = VULKAN_DEVICES_MAX;
    *count = 0;
    const VkResult result = vkEnumeratePhysicalDevices(instance, &all_count, all);
    if (result < 0) /* with more devices than room it is VK_INCOMPLETE */
        return fail_instance(err, result);
    for (uint32_t i = 0; i < all_count; i++) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(all[i], &properties);
        if (properties.apiVersion < VK_API_VERSION_1_3 || vulkan_queue_family(all[i]) == UINT32_MAX)
            continue;
        size_t at = (*count)++;
        for (; at > 0 && ranks[at - 1] > rank(&properties); at--) {
            ranks[at] = ranks[at - 1];
            found[at] = found[at - 1];
        }
        ranks[at] = rank(&properties);
        found[at] = all[i];
    }
    return FM_OK;
}
