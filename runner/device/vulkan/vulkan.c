#include "vulkan.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "device/selector.h"

static fm_status list_devices(fm_device_entry *entries, size_t *count, fm_error *err)
{
    const size_t room = *count;
    VkInstance instance = VK_NULL_HANDLE;
    vulkan_validation none = { .errors = 0 };
    VkPhysicalDevice found[VULKAN_DEVICES_MAX];
    fm_status status = vulkan_instance_create(&instance, &none, false, err);
    *count = 0;
    if (status == FM_OK)
        status = vulkan_find_devices(found, count, instance, err);
    if (*count > room)
        *count = room;
    for (size_t i = 0; i < *count; i++) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(found[i], &properties);
        snprintf(entries[i].selector, sizeof entries[i].selector, "vulkan:%zu", i);
        snprintf(entries[i].name, sizeof entries[i].name, "%.127s", properties.deviceName);
    }
    vulkan_instance_destroy(instance, &none);
    return status == FM_UNSUPPORTED ? FM_OK : status; /* no driver: an empty list */
}

static bool matches(VkPhysicalDevice physical, size_t index, const char *selector)
{
    VkPhysicalDeviceProperties properties;
    vkGetPhysicalDeviceProperties(physical, &properties);
    return selector_matches(selector, index, properties.deviceName);
}

static fm_status fail_choice(fm_error *err, const VkPhysicalDevice *found, size_t count,
                             const char *selector)
{
    char names[1024] = "";
    size_t length = 0;
    for (size_t i = 0; i < count && length < sizeof names; i++) {
        VkPhysicalDeviceProperties properties;
        vkGetPhysicalDeviceProperties(found[i], &properties);
        length += (size_t)snprintf(names + length, sizeof names - length, "%s%zu '%s'",
                                   i > 0 ? ", " : "", i, properties.deviceName);
    }
    return fm_fail(err, FM_INVALID, "vulkan:%s: no such device; there is %s", selector, names);
}

static fm_status choose_device(vulkan *self, const char *selector, fm_error *err)
{
    VkPhysicalDevice found[VULKAN_DEVICES_MAX];
    size_t count = 0;
    const fm_status status = vulkan_find_devices(found, &count, self->instance, err);
    if (status != FM_OK)
        return status;
    if (count == 0)
        return fm_refuse(err, FM_REASON_DRIVER,
                         "vulkan: no device with Vulkan 1.3; without a GPU: apt-get install "
                         "mesa-vulkan-drivers");
    for (size_t i = 0; i < count; i++) {
        if (matches(found[i], i, selector)) {
            self->physical = found[i];
            self->queue_family = vulkan_queue_family(found[i]);
            return FM_OK;
        }
    }
    return fail_choice(err, found, count, selector);
}

static fm_status create_commands(vulkan *self, fm_error *err)
{
    VkCommandBuffer buffers[2];
    const VkCommandPoolCreateInfo pool = {
        .sType = VK_STRUCTURE_TYPE_COMMAND_POOL_CREATE_INFO,
        .flags = VK_COMMAND_POOL_CREATE_RESET_COMMAND_BUFFER_BIT,
        .queueFamilyIndex = self->queue_family,
    };
    const VkFenceCreateInfo fence = { .sType = VK_STRUCTURE_TYPE_FENCE_CREATE_INFO };
    const VkSamplerCreateInfo sampler = { .sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO };
    VkResult result = vkCreateCommandPool(self->device, &pool, NULL, &self->commands);
    if (result == VK_SUCCESS)
        result =
            vkAllocateCommandBuffers(self->device,
                                     &(VkCommandBufferAllocateInfo){
                                         .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_ALLOCATE_INFO,
                                         .commandPool = self->commands,
                                         .commandBufferCount = 2,
                                     },
                                     buffers);
    if (result == VK_SUCCESS) {
        self->frame_commands = buffers[0];
        self->transfer_commands = buffers[1];
        result = vkCreateFence(self->device, &fence, NULL, &self->fence);
    }
    if (result == VK_SUCCESS)
        result = vkCreateSampler(self->device, &sampler, NULL, &self->sampler);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "vulkan: command buffers");
}

static void close_device(fm_device *device)
{
    vulkan *self = (vulkan *)device;
    if (self == NULL)
        return;
    if (self->device != VK_NULL_HANDLE) {
        vulkan_staging_destroy(self, self->staging);
        vulkan_queries_destroy(self);
        vulkan_bind_destroy(self);
    }
    if (self->device != VK_NULL_HANDLE && !self->has_hung) {
        vkDestroySampler(self->device, self->sampler, NULL);
        vkDestroyFence(self->device, self->fence, NULL);
        vkDestroyCommandPool(self->device, self->commands, NULL);
        vkDestroyDevice(self->device, NULL);
    }
    if (self->has_hung) /* the driver still works on it, and messages would come to *self */
        return;
    glsl_compiler_end(&self->compiler);
    vulkan_instance_destroy(self->instance, &self->validation);
    free(self);
}

/* A driver that is missing or does not work says nothing of a device. */
static fm_status no_driver(fm_status status, fm_error *err)
{
    if (status != FM_UNSUPPORTED)
        return status;
    if (err != NULL) {
        err->status = FM_IO;
        err->reason = FM_REASON_NONE;
    }
    return FM_IO;
}

static fm_status open_device(fm_device **device, const fm_device_desc *desc, fm_error *err)
{
    *device = NULL;
    vulkan *self = calloc(1, sizeof *self);
    if (self == NULL)
        return fm_fail(err, FM_NO_MEMORY, "vulkan: %zu bytes", sizeof *self);
    self->base.ops = &vulkan_device;
    self->no_timers = desc->no_timers;
    self->compiler.cache = desc->cache;
    fm_status status =
        vulkan_instance_create(&self->instance, &self->validation, desc->validation, err);
    if (status == FM_OK)
        status = choose_device(self, desc->selector, err);
    status = no_driver(status, err);
    if (status == FM_OK) {
        vulkan_caps_find(self);
        status = vulkan_logical_device_create(self, err);
    }
    if (status == FM_OK)
        status = create_commands(self, err);
    if (status == FM_OK)
        status = vulkan_staging_create(&self->staging, self, err);
    if (status == FM_OK)
        status = vulkan_queries_create(self, err);
    if (status != FM_OK)
        goto out;
    *device = &self->base;
    self = NULL;
out:
    close_device(self != NULL ? &self->base : NULL);
    return status;
}

static uint32_t validation_errors(const fm_device *device, const char **first)
{
    const vulkan *self = (const vulkan *)device;
    *first = self->validation.first;
    return self->validation.errors;
}

const fm_device_ops vulkan_device = {
    .name = "vulkan",
    .list = list_devices,
    .open = open_device,
    .close = close_device,
    .validation_errors = validation_errors,
    .buffer_create = vulkan_buffer_create,
    .buffer_destroy = vulkan_buffer_destroy,
    .buffer_address = vulkan_buffer_address,
    .buffer_write = vulkan_buffer_write,
    .buffer_read = vulkan_buffer_read,
    .image_create = vulkan_image_create,
    .image_destroy = vulkan_image_destroy,
    .pipeline_create = vulkan_pipeline_create,
    .pipeline_destroy = vulkan_pipeline_destroy,
    .frame_begin = vulkan_frame_begin,
    .frame_end = vulkan_frame_end,
    .timer_begin = vulkan_timer_begin,
    .timer_end = vulkan_timer_end,
    .fill = vulkan_fill,
    .update = vulkan_update,
    .image_clear = vulkan_image_clear,
    .dispatch = vulkan_dispatch,
    .draw = vulkan_draw,
};
