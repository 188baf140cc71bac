#include <assert.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "context.h"
#include "device/ledger.h"
#include "model/formats.h"

enum { SAMPLES_MAX = 16 };

static const vulkan_format formats[] = {
    [FM_FORMAT_NONE] = { .format = VK_FORMAT_UNDEFINED },
    [FM_FORMAT_R32UI] = { .format = VK_FORMAT_R32_UINT },
    [FM_FORMAT_RG32UI] = { .format = VK_FORMAT_R32G32_UINT },
    [FM_FORMAT_RGBA32UI] = { .format = VK_FORMAT_R32G32B32A32_UINT },
    [FM_FORMAT_R32F] = { .format = VK_FORMAT_R32_SFLOAT },
    [FM_FORMAT_RG32F] = { .format = VK_FORMAT_R32G32_SFLOAT },
    [FM_FORMAT_RGBA32F] = { .format = VK_FORMAT_R32G32B32A32_SFLOAT },
    [FM_FORMAT_RGBA8] = { .format = VK_FORMAT_R8G8B8A8_UNORM },
    [FM_FORMAT_D32F] = { .format = VK_FORMAT_D32_SFLOAT, .has_depth = true },
    [FM_FORMAT_D32F_S8] = { .format = VK_FORMAT_D32_SFLOAT_S8_UINT,
                            .has_depth = true,
                            .has_stencil = true },
    [FM_FORMAT_R8] = { .format = VK_FORMAT_R8_UNORM },
    [FM_FORMAT_R16] = { .format = VK_FORMAT_R16_UNORM },
    [FM_FORMAT_RG16] = { .format = VK_FORMAT_R16G16_UNORM },
    [FM_FORMAT_RGBA16] = { .format = VK_FORMAT_R16G16B16A16_UNORM },
    [FM_FORMAT_R16F] = { .format = VK_FORMAT_R16_SFLOAT },
    [FM_FORMAT_RG16F] = { .format = VK_FORMAT_R16G16_SFLOAT },
    [FM_FORMAT_RGBA16F] = { .format = VK_FORMAT_R16G16B16A16_SFLOAT },
};
_Static_assert(sizeof formats / sizeof formats[0] == FM_FORMAT_COUNT, "one a format");

const vulkan_format *vulkan_format_of(fm_format format)
{
    return &formats[format];
}

VkImageUsageFlags vulkan_format_usage(fm_format format)
{
    return VK_IMAGE_USAGE_SAMPLED_BIT | VK_IMAGE_USAGE_TRANSFER_DST_BIT |
           (formats[format].has_depth ? VK_IMAGE_USAGE_DEPTH_STENCIL_ATTACHMENT_BIT
                                      : VK_IMAGE_USAGE_COLOR_ATTACHMENT_BIT);
}

bool vulkan_format_limits(VkImageFormatProperties *limits, VkPhysicalDevice physical,
                          fm_format format, VkImageUsageFlags usage)
{
    return vkGetPhysicalDeviceImageFormatProperties(physical, formats[format].format,
                                                    VK_IMAGE_TYPE_2D, VK_IMAGE_TILING_OPTIMAL,
                                                    usage, 0, limits) == VK_SUCCESS;
}

/* The flags' values are the counts; as ours, bit s says that s samples are possible. */
static uint32_t sample_bits(VkSampleCountFlags counts)
{
    uint32_t bits = 0;
    for (uint32_t samples = 1; samples <= SAMPLES_MAX; samples *= 2) {
        if ((counts & samples) != 0)
            bits |= 1u << samples;
    }
    return bits;
}

uint32_t vulkan_format_samples(VkPhysicalDevice physical, fm_format first, fm_format last)
{
    uint32_t common = ~0u;
    for (fm_format format = first; format <= last; format++) {
        VkImageFormatProperties limits = { .sampleCounts = 0 };
        const bool is_possible =
            vulkan_format_limits(&limits, physical, format, vulkan_format_usage(format));
        common &= is_possible ? sample_bits(limits.sampleCounts) : 0;
    }
    return common;
}

VkClearColorValue vulkan_clear_colour(const float colour[4])
{
    VkClearColorValue value;
    memcpy(&value, colour, sizeof value);
    return value;
}

static uint64_t bytes_of(const fm_image_desc *desc, uint32_t samples, uint32_t layers)
{
    return (uint64_t)desc->width_px * desc->height_px * layers * samples *
           format_bytes(desc->format);
}

static fm_status check_bytes(const vulkan *self, const char *name, uint64_t bytes, fm_error *err)
{
    const uint64_t most = self->base.caps.image_max_bytes;
    return bytes <= most ? FM_OK
                         : fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                                     "image '%s': %llu bytes, this device's most are %llu", name,
                                     (unsigned long long)bytes, (unsigned long long)most);
}

static fm_status check_image(const VkImageFormatProperties *limits, const fm_image_desc *desc,
                             uint32_t samples, uint32_t layers, fm_error *err)
{
    if (desc->width_px > limits->maxExtent.width || desc->height_px > limits->maxExtent.height)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u x %u pixels, this device's most are %u x %u", desc->name,
                         desc->width_px, desc->height_px, limits->maxExtent.width,
                         limits->maxExtent.height);
    if (layers > limits->maxArrayLayers)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u layers, this device's most are %u", desc->name, layers,
                         limits->maxArrayLayers);
    if ((samples & (samples - 1)) != 0 || (limits->sampleCounts & samples) == 0)
        return fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                         "image '%s': %u samples are not possible here", desc->name, samples);
    return FM_OK;
}

/* The usage, with stores from shaders if this format and number of samples allow them. */
static fm_status find_usage(VkImageUsageFlags *usage, const vulkan *self, const fm_image_desc *desc,
                            uint32_t samples, uint32_t layers, fm_error *err)
{
    VkImageFormatProperties limits;
    *usage = vulkan_format_usage(desc->format);
    if (!vulkan_format_limits(&limits, self->physical, desc->format, *usage))
        return fm_refuse(err, FM_REASON_FEATURE, "image '%s': this device lacks its format",
                         desc->name);
    const fm_status status = check_image(&limits, desc, samples, layers, err);
    if (status != FM_OK || vulkan_format_of(desc->format)->has_depth)
        return status;
    const bool may_store = samples == 1 || self->can_store_multisampled;
    if (may_store &&
        vulkan_format_limits(&limits, self->physical, desc->format,
                             *usage | VK_IMAGE_USAGE_STORAGE_BIT) &&
        (limits.sampleCounts & samples) != 0)
        *usage |= VK_IMAGE_USAGE_STORAGE_BIT;
    return FM_OK;
}

static VkResult create_view(VkImageView *view, const vulkan *self, const fm_image_resource *image,
                            VkFormat format, VkImageViewType type,
                            const VkImageSubresourceRange *range)
{
    const VkImageViewCreateInfo info = { .sType = VK_STRUCTURE_TYPE_IMAGE_VIEW_CREATE_INFO,
                                         .image = image->image,
                                         .viewType = type,
                                         .format = format,
                                         .subresourceRange = *range };
    return vkCreateImageView(self->device, &info, NULL, view);
}

static void release(const vulkan *self, fm_image_resource *image)
{
    if (image != NULL && !self->has_hung) {
        vkDestroyImageView(self->device, image->target_view, NULL);
        vkDestroyImageView(self->device, image->shader_view, NULL);
        vkDestroyImage(self->device, image->image, NULL);
        vkFreeMemory(self->device, image->memory, NULL);
    }
    free(image);
}

static fm_status to_general_layout(vulkan *self, const fm_image_resource *image, fm_error *err)
{
    const VkImageMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
        .dstAccessMask = VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT,
        .oldLayout = VK_IMAGE_LAYOUT_UNDEFINED,
        .newLayout = VK_IMAGE_LAYOUT_GENERAL,
        .image = image->image,
        .subresourceRange = { .aspectMask = image->aspects,
                              .levelCount = 1,
                              .layerCount = VK_REMAINING_ARRAY_LAYERS },
    };
    const VkDependencyInfo info = { .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .imageMemoryBarrierCount = 1,
                                    .pImageMemoryBarriers = &barrier };
    const fm_status status = vulkan_transfer_begin(self, err);
    if (status != FM_OK)
        return status;
    vkCmdPipelineBarrier2(self->transfer_commands, &info);
    return vulkan_transfer_end(self, err);
}

/* Targets are the first layer; shaders see all, and of depth and stencil the depth. */
static VkResult create_views(fm_image_resource *image, const vulkan *self,
                             const fm_image_desc *desc, uint32_t layers)
{
    const vulkan_format *format = vulkan_format_of(desc->format);
    const VkImageSubresourceRange target = { .aspectMask = image->aspects,
                                             .levelCount = 1,
                                             .layerCount = 1 };
    const VkImageSubresourceRange shader = { .aspectMask = format->has_depth
                                                               ? VK_IMAGE_ASPECT_DEPTH_BIT
                                                               : VK_IMAGE_ASPECT_COLOR_BIT,
                                             .levelCount = 1,
                                             .layerCount = layers };
    const VkImageViewType type =
        layers > 1 || desc->is_array ? VK_IMAGE_VIEW_TYPE_2D_ARRAY : VK_IMAGE_VIEW_TYPE_2D;
    const VkResult result = create_view(&image->target_view, self, image, format->format,
                                        VK_IMAGE_VIEW_TYPE_2D, &target);
    return result != VK_SUCCESS
               ? result
               : create_view(&image->shader_view, self, image, format->format, type, &shader);
}

static VkImageAspectFlags aspects_of(fm_format format)
{
    if (!vulkan_format_of(format)->has_depth)
        return VK_IMAGE_ASPECT_COLOR_BIT;
    return VK_IMAGE_ASPECT_DEPTH_BIT |
           (vulkan_format_of(format)->has_stencil ? VK_IMAGE_ASPECT_STENCIL_BIT : 0u);
}

static fm_status back_with_memory(fm_image_resource *image, const vulkan *self, const char *name,
                                  fm_error *err)
{
    vulkan_memory_desc desc = { .kind = VULKAN_MEMORY_DEVICE };
    vulkan_memory memory;
    vkGetImageMemoryRequirements(self->device, image->image, &desc.needs);
    fm_status status = check_bytes(self, name, desc.needs.size, err); /* padded */
    if (status != FM_OK)
        return status;
    status = vulkan_memory_allocate(&memory, self, &desc, err);
    if (status != FM_OK && err != NULL)
        fm_error_prefix(err, "image '%s'", name);
    if (status != FM_OK)
        return status;
    image->memory = memory.memory;
    const VkResult result = vkBindImageMemory(self->device, image->image, image->memory, 0);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "image '%s'", name);
}

/* Creates the image, its memory and its views into *image, which the caller releases on failure. */
static fm_status make(fm_image_resource *image, vulkan *self, const fm_image_desc *desc,
                      VkImageUsageFlags usage, uint32_t layers, fm_error *err)
{
    const VkImageCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_IMAGE_CREATE_INFO,
        .imageType = VK_IMAGE_TYPE_2D,
        .format = vulkan_format_of(desc->format)->format,
        .extent = { desc->width_px, desc->height_px, 1 },
        .mipLevels = 1,
        .arrayLayers = layers,
        .samples = (VkSampleCountFlagBits)(desc->samples > 1 ? desc->samples : 1),
        .usage = usage,
    };
    VkResult result = vkCreateImage(self->device, &info, NULL, &image->image);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "image '%s'", desc->name);
    const fm_status status = back_with_memory(image, self, desc->name, err);
    if (status != FM_OK)
        return status;
    result = create_views(image, self, desc, layers);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "image '%s': view", desc->name);
    return to_general_layout(self, image, err);
}

fm_status vulkan_image_create(fm_image_resource **image, fm_device *device,
                              const fm_image_desc *desc, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    const uint32_t layers = desc->layers > 1 ? desc->layers : 1;
    const uint32_t samples = desc->samples > 1 ? desc->samples : 1;
    VkImageUsageFlags usage = 0;
    *image = NULL;
    fm_status status = find_usage(&usage, self, desc, samples, layers, err);
    if (status == FM_OK)
        status = check_bytes(self, desc->name, bytes_of(desc, samples, layers), err);
    if (status != FM_OK)
        return status;
    fm_image_resource *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "image '%s': %zu bytes", desc->name, sizeof *made);
    made->aspects = aspects_of(desc->format);
    made->width_px = desc->width_px;
    made->height_px = desc->height_px;
    made->owner = desc->owner;
    made->can_store = (usage & VK_IMAGE_USAGE_STORAGE_BIT) != 0;
    snprintf(made->name, sizeof made->name, "%s", desc->name);
    made->bytes = bytes_of(desc, samples, layers);
    status = make(made, self, desc, usage, layers, err);
    if (status != FM_OK)
        goto out;
    ledger_add(&device->ledger, made->owner, made->bytes);
    *image = made;
    made = NULL;
out:
    release(self, made);
    return status;
}

void vulkan_image_destroy(fm_device *device, fm_image_resource *image)
{
    if (image == NULL)
        return;
    ledger_remove(&device->ledger, image->owner, image->bytes);
    release((vulkan *)device, image);
}
