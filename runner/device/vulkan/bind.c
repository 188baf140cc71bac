#include <stdlib.h>

#include "context.h"

enum { SETS_PER_POOL = 256, DESCRIPTORS_PER_SET = 8 }; /* of each kind, on average */

static fm_status add_pool(vulkan *self, fm_error *err)
{
    vulkan_descriptors *all = &self->descriptors;
    const VkDescriptorPoolSize sizes[] = {
        { VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER, SETS_PER_POOL * DESCRIPTORS_PER_SET },
        { VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, SETS_PER_POOL * DESCRIPTORS_PER_SET },
        { VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER, SETS_PER_POOL * DESCRIPTORS_PER_SET },
        { VK_DESCRIPTOR_TYPE_STORAGE_IMAGE, SETS_PER_POOL * DESCRIPTORS_PER_SET },
    };
    const VkDescriptorPoolCreateInfo info = {
        .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_POOL_CREATE_INFO,
        .maxSets = SETS_PER_POOL,
        .poolSizeCount = sizeof sizes / sizeof sizes[0],
        .pPoolSizes = sizes,
    };
    VkDescriptorPool *pools = realloc(all->pools, (all->count + 1) * sizeof(VkDescriptorPool));
    if (pools == NULL)
        return fm_fail(err, FM_NO_MEMORY, "vulkan: descriptor pools");
    all->pools = pools;
    const VkResult result = vkCreateDescriptorPool(self->device, &info, NULL, &pools[all->count]);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "vulkan: descriptor pool");
    all->count++;
    return FM_OK;
}

/* A set from the current pool, or from the next one when that is used up. */
static fm_status allocate(VkDescriptorSet *set, vulkan *self, const fm_pipeline *pipeline,
                          fm_error *err)
{
    vulkan_descriptors *all = &self->descriptors;
    for (int is_fresh = 0;; all->current++) {
        if (all->current == all->count) {
            const fm_status status = add_pool(self, err);
            if (status != FM_OK)
                return status;
            is_fresh = 1;
        }
        const VkDescriptorSetAllocateInfo info = {
            .sType = VK_STRUCTURE_TYPE_DESCRIPTOR_SET_ALLOCATE_INFO,
            .descriptorPool = all->pools[all->current],
            .descriptorSetCount = 1,
            .pSetLayouts = &pipeline->set_layout,
        };
        const VkResult result = vkAllocateDescriptorSets(self->device, &info, set);
        if (result == VK_SUCCESS)
            return FM_OK;
        const bool is_full =
            result == VK_ERROR_OUT_OF_POOL_MEMORY || result == VK_ERROR_FRAGMENTED_POOL;
        if (!is_full || is_fresh)
            return vulkan_fail(err, result, "vulkan: descriptor set");
    }
}

static VkWriteDescriptorSet write_buffer(VkDescriptorBufferInfo *info, const fm_bind *bind)
{
    *info =
        (VkDescriptorBufferInfo){ .buffer = bind->buffer->buffer, .range = bind->buffer->bytes };
    return (VkWriteDescriptorSet){
        .descriptorType = bind->kind == FM_BINDING_UNIFORM ? VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER
                                                           : VK_DESCRIPTOR_TYPE_STORAGE_BUFFER,
        .pBufferInfo = info,
    };
}

static VkWriteDescriptorSet write_image(VkDescriptorImageInfo *info, const vulkan *self,
                                        const fm_bind *bind)
{
    *info = (VkDescriptorImageInfo){ .sampler = self->sampler,
                                     .imageView = bind->image->shader_view,
                                     .imageLayout = VK_IMAGE_LAYOUT_GENERAL };
    return (VkWriteDescriptorSet){
        .descriptorType = bind->kind == FM_BINDING_SAMPLED
                              ? VK_DESCRIPTOR_TYPE_COMBINED_IMAGE_SAMPLER
                              : VK_DESCRIPTOR_TYPE_STORAGE_IMAGE,
        .pImageInfo = info,
    };
}

static fm_status check_stores(const fm_bind *binds, uint32_t count, fm_error *err)
{
    for (uint32_t i = 0; i < count; i++)
        if (binds[i].kind == FM_BINDING_STORAGE_IMAGE && !binds[i].image->can_store)
            return fm_refuse(err, FM_REASON_FEATURE,
                             "image '%s': shaders cannot store into its format, or into so many "
                             "samples, on this device",
                             binds[i].image->name);
    return FM_OK;
}

fm_status vulkan_bind(vulkan *self, const fm_pipeline *pipeline, const fm_bind *binds,
                      uint32_t count, fm_error *err)
{
    VkDescriptorBufferInfo buffers[FM_MAX_BINDINGS];
    VkDescriptorImageInfo images[FM_MAX_BINDINGS];
    VkWriteDescriptorSet writes[FM_MAX_BINDINGS];
    VkDescriptorSet set;
    uint32_t write_count = 0;
    fm_status status = check_stores(binds, count, err);
    if (status == FM_OK)
        status = allocate(&set, self, pipeline, err);
    if (status != FM_OK)
        return status;
    for (uint32_t i = 0; i < count; i++) {
        if (binds[i].kind == FM_BINDING_ADDRESS) /* for barriers only */
            continue;
        if (write_count == FM_MAX_BINDINGS)
            return fm_refuse(err, FM_REASON_SUITE_LIMIT, "more than %d bindings", FM_MAX_BINDINGS);
        VkWriteDescriptorSet *write = &writes[write_count];
        *write = binds[i].buffer != NULL ? write_buffer(&buffers[write_count], &binds[i])
                                         : write_image(&images[write_count], self, &binds[i]);
        write->sType = VK_STRUCTURE_TYPE_WRITE_DESCRIPTOR_SET;
        write->dstSet = set;
        write->dstBinding = binds[i].binding;
        write->descriptorCount = 1;
        write_count++;
    }
    vkUpdateDescriptorSets(self->device, write_count, writes, 0, NULL);
    vkCmdBindDescriptorSets(self->frame_commands, pipeline->bind_point, pipeline->layout, 0, 1,
                            &set, 0, NULL);
    return FM_OK;
}

fm_status vulkan_bind_reset(vulkan *self, fm_error *err)
{
    vulkan_descriptors *all = &self->descriptors;
    for (uint32_t i = 0; i < all->count && i <= all->current; i++) {
        const VkResult result = vkResetDescriptorPool(self->device, all->pools[i], 0);
        if (result != VK_SUCCESS)
            return vulkan_fail(err, result, "vulkan: descriptor pool");
    }
    all->current = 0;
    return FM_OK;
}

void vulkan_bind_destroy(vulkan *self)
{
    for (uint32_t i = 0; i < self->descriptors.count && !self->has_hung; i++)
        vkDestroyDescriptorPool(self->device, self->descriptors.pools[i], NULL);
    free(self->descriptors.pools);
    self->descriptors = (vulkan_descriptors){ .count = 0 };
}
