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

static void add_draw_barrier(const vulkan *self, const fm_draw *draw)
{
    const VkPipelineStageFlags2 depth_stages =
        VK_PIPELINE_STAGE_2_EARLY_FRAGMENT_TESTS_BIT | VK_PIPELINE_STAGE_2_LATE_FRAGMENT_TESTS_BIT;
    VkMemoryBarrier2 barrier = vulkan_barrier_begin();
    if (draw->vertices != NULL)
        vulkan_barrier_add(&barrier, &draw->vertices->access, self->epoch,
                           VK_PIPELINE_STAGE_2_VERTEX_ATTRIBUTE_INPUT_BIT,
                           VK_ACCESS_2_VERTEX_ATTRIBUTE_READ_BIT);
    if (draw->indices != NULL)
        vulkan_barrier_add(&barrier, &draw->indices->access, self->epoch,
                           VK_PIPELINE_STAGE_2_INDEX_INPUT_BIT, VK_ACCESS_2_INDEX_READ_BIT);
    vulkan_barrier_add_binds(&barrier, self->epoch, draw->binds, draw->bind_count,
                             VK_PIPELINE_STAGE_2_VERTEX_SHADER_BIT |
                                 VK_PIPELINE_STAGE_2_FRAGMENT_SHADER_BIT);
    for (uint32_t i = 0; i < draw->target_count; i++)
        vulkan_barrier_add(&barrier, &draw->targets[i]->access, self->epoch,
                           VK_PIPELINE_STAGE_2_COLOR_ATTACHMENT_OUTPUT_BIT,
                           VK_ACCESS_2_COLOR_ATTACHMENT_READ_BIT |
                               VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT);
    if (draw->depth_stencil != NULL)
        vulkan_barrier_add(&barrier, &draw->depth_stencil->access, self->epoch, depth_stages,
                           VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_READ_BIT |
                               VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT);
    vulkan_barrier_record(self->frame_commands, &barrier);
}

static VkRenderingAttachmentInfo attachment(const fm_image_resource *image, fm_load load,
                                            VkClearValue clear)
{
    return (VkRenderingAttachmentInfo){
        .sType = VK_STRUCTURE_TYPE_RENDERING_ATTACHMENT_INFO,
        .imageView = image->target_view,
        .imageLayout = VK_IMAGE_LAYOUT_GENERAL,
        .loadOp = load == FM_LOAD_CLEAR ? VK_ATTACHMENT_LOAD_OP_CLEAR : VK_ATTACHMENT_LOAD_OP_LOAD,
        .storeOp = VK_ATTACHMENT_STORE_OP_STORE,
        .clearValue = clear,
    };
}

static void begin_rendering(const vulkan *self, const fm_draw *draw)
{
    VkRenderingAttachmentInfo targets[FM_MAX_TARGETS], depth;
    VkRenderingInfo info = {
        .sType = VK_STRUCTURE_TYPE_RENDERING_INFO,
        .renderArea = { .extent = { draw->width_px, draw->height_px } },
        .layerCount = 1,
        .colorAttachmentCount = draw->target_count,
        .pColorAttachments = targets,
    };
    for (uint32_t i = 0; i < draw->target_count; i++) {
        const VkClearValue clear = { .color = vulkan_clear_colour(draw->target_clears[i]) };
        targets[i] = attachment(draw->targets[i], draw->target_loads[i], clear);
    }
    if (draw->depth_stencil != NULL) {
        const VkClearValue clear = { .depthStencil = { draw->clear_depth, draw->clear_stencil } };
        depth = attachment(draw->depth_stencil, draw->depth_stencil_load, clear);
        info.pDepthAttachment = &depth;
        if ((draw->depth_stencil->aspects & VK_IMAGE_ASPECT_STENCIL_BIT) != 0)
            info.pStencilAttachment = &depth;
    }
    vkCmdBeginRendering(self->frame_commands, &info);
}

static void set_area(VkCommandBuffer commands, const fm_draw *draw)
{
    const VkViewport viewport = { .width = (float)draw->width_px,
                                  .height = (float)draw->height_px,
                                  .maxDepth = 1.0f };
    const VkRect2D scissor = { .extent = { draw->width_px, draw->height_px } };
    vkCmdSetViewport(commands, 0, 1, &viewport);
    vkCmdSetScissor(commands, 0, 1, &scissor);
}

static void issue(VkCommandBuffer commands, const fm_draw *draw)
{
    const VkDeviceSize start = 0;
    if (draw->vertices != NULL)
        vkCmdBindVertexBuffers(commands, 0, 1, &draw->vertices->buffer, &start);
    if (draw->indices != NULL) {
        vkCmdBindIndexBuffer(commands, draw->indices->buffer, 0, VK_INDEX_TYPE_UINT32);
        vkCmdDrawIndexed(commands, draw->vertex_count, draw->instance_count, 0, 0, 0);
    } else {
        vkCmdDraw(commands, draw->vertex_count, draw->instance_count, 0, 0);
    }
}

static fm_status check_query(const vulkan *self, const fm_draw *draw, fm_error *err)
{
    if (draw->query < 0)
        return FM_OK;
    assert(draw->query < FM_MAX_QUERIES);
    if (!self->can_query_precisely)
        return fm_refuse(err, FM_REASON_FEATURE, "draw: this device cannot count samples exactly");
    if (self->occlusions.count == self->occlusions.capacity)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT, "draw: more than %u queries in a frame",
                         self->occlusions.capacity);
    return FM_OK;
}

static fm_status check_images(const fm_draw *draw, fm_error *err)
{
    for (uint32_t i = 0; i <= draw->target_count; i++) {
        const fm_image_resource *image =
            i < draw->target_count ? draw->targets[i] : draw->depth_stencil;
        if (image != NULL &&
            (image->width_px < draw->width_px || image->height_px < draw->height_px))
            return fm_fail(err, FM_INVALID, "draw: %u x %u pixels into an image of %u x %u",
                           draw->width_px, draw->height_px, image->width_px, image->height_px);
    }
    return FM_OK;
}

fm_status vulkan_draw(fm_device *device, const fm_draw *draw, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    const VkCommandBuffer commands = self->frame_commands;
    const uint32_t query = self->occlusions.count;
    fm_status status = check_query(self, draw, err);
    if (status == FM_OK)
        status = check_images(draw, err);
    if (status == FM_OK)
        status = vulkan_bind(self, draw->pipeline, draw->binds, draw->bind_count, err);
    if (status != FM_OK)
        return status;
    add_draw_barrier(self, draw);
    begin_rendering(self, draw);
    set_area(commands, draw);
    vkCmdBindPipeline(commands, VK_PIPELINE_BIND_POINT_GRAPHICS, draw->pipeline->pipeline);
    if (draw->query >= 0) {
        self->occlusions.slot[self->occlusions.count++] = (uint8_t)draw->query;
        vkCmdBeginQuery(commands, self->occlusions.pool, query, VK_QUERY_CONTROL_PRECISE_BIT);
    }
    issue(commands, draw);
    if (draw->query >= 0)
        vkCmdEndQuery(commands, self->occlusions.pool, query);
    vkCmdEndRendering(commands);
    return FM_OK;
}
