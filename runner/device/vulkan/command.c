#include <assert.h>

#include "context.h"
#include "device/dispatch.h"

enum { UPDATE_MAX_BYTES = 65536 };

static void wait_for_transfer(vulkan *self, vulkan_access *access)
{
    VkMemoryBarrier2 barrier = vulkan_barrier_begin();
    vulkan_barrier_add(&barrier, access, self->epoch, VK_PIPELINE_STAGE_2_ALL_TRANSFER_BIT,
                       VK_ACCESS_2_TRANSFER_WRITE_BIT);
    vulkan_barrier_record(self->frame_commands, &barrier);
}

void vulkan_fill(fm_device *device, fm_buffer *buffer, uint32_t word)
{
    vulkan *self = (vulkan *)device;
    wait_for_transfer(self, &buffer->access);
    vkCmdFillBuffer(self->frame_commands, buffer->buffer, 0, VK_WHOLE_SIZE, word);
}

void vulkan_update(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes, const void *bytes,
                   uint32_t count)
{
    vulkan *self = (vulkan *)device;
    assert(count <= UPDATE_MAX_BYTES && count % 4 == 0);
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    wait_for_transfer(self, &buffer->access);
    vkCmdUpdateBuffer(self->frame_commands, buffer->buffer, offset_bytes, count, bytes);
}

void vulkan_image_clear(fm_device *device, fm_image_resource *image, const float colour[4],
                        float depth, uint32_t stencil)
{
    vulkan *self = (vulkan *)device;
    const VkImageSubresourceRange range = { .aspectMask = image->aspects,
                                            .levelCount = 1,
                                            .layerCount = VK_REMAINING_ARRAY_LAYERS };
    wait_for_transfer(self, &image->access);
    if ((image->aspects & VK_IMAGE_ASPECT_COLOR_BIT) != 0) {
        const VkClearColorValue value = vulkan_clear_colour(colour);
        vkCmdClearColorImage(self->frame_commands, image->image, VK_IMAGE_LAYOUT_GENERAL, &value, 1,
                             &range);
        return;
    }
    const VkClearDepthStencilValue value = { .depth = depth, .stencil = stencil };
    vkCmdClearDepthStencilImage(self->frame_commands, image->image, VK_IMAGE_LAYOUT_GENERAL, &value,
                                1, &range);
}

fm_status vulkan_dispatch(fm_device *device, const fm_dispatch *dispatch, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    const VkCommandBuffer commands = self->frame_commands;
    VkMemoryBarrier2 barrier = vulkan_barrier_begin();
    fm_status status = dispatch_check_groups(device, dispatch, err);
    if (status == FM_OK)
        status = vulkan_bind(self, dispatch->pipeline, dispatch->binds, dispatch->bind_count, err);
    if (status != FM_OK)
        return status;
    if (dispatch->indirect != NULL)
        vulkan_barrier_add(&barrier, &dispatch->indirect->access, self->epoch,
                           VK_PIPELINE_STAGE_2_DRAW_INDIRECT_BIT,
                           VK_ACCESS_2_INDIRECT_COMMAND_READ_BIT);
    vulkan_barrier_add_binds(&barrier, self->epoch, dispatch->binds, dispatch->bind_count,
                             VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT);
    vulkan_barrier_record(commands, &barrier);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_COMPUTE, dispatch->pipeline->pipeline);
    if (dispatch->indirect != NULL)
        vkCmdDispatchIndirect(commands, dispatch->indirect->buffer, 0);
    else
        vkCmdDispatch(commands, dispatch->groups[0], dispatch->groups[1], dispatch->groups[2]);
    return FM_OK;
}
