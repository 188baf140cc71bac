#include <string.h>

#include "context.h"

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
