#include <assert.h>
#include <string.h>

#include "context.h"

/* A mapped buffer that the host does not cache is read word by word over the bus: from here on a
 * copy by the GPU is faster. */
enum { UNCACHED_READ_MAX_BYTES = 4096 };

fm_status vulkan_submit(vulkan *self, VkCommandBuffer commands, const char *what, fm_error *err)
{
    const VkCommandBufferSubmitInfo buffer = { .sType =
                                                   VK_STRUCTURE_TYPE_COMMAND_BUFFER_SUBMIT_INFO,
                                               .commandBuffer = commands };
    const VkSubmitInfo2 submit = { .sType = VK_STRUCTURE_TYPE_SUBMIT_INFO_2,
                                   .commandBufferInfoCount = 1,
                                   .pCommandBufferInfos = &buffer };
    VkResult result = vkEndCommandBuffer(commands);
    if (result == VK_SUCCESS)
        result = vkQueueSubmit2(self->queue, 1, &submit, self->fence);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "%s: submitting", what);
    result = vkWaitForFences(self->device, 1, &self->fence, VK_TRUE,
                             self->base.caps.is_software ? UINT64_MAX : VULKAN_WAIT_NS);
    if (result == VK_TIMEOUT) {
        self->has_hung = true;
        return fm_fail(err, FM_DEVICE_LOST, "%s: the GPU did not finish within %llu s", what,
                       VULKAN_WAIT_NS / 1000000000ull);
    }
    if (result == VK_SUCCESS)
        result = vkResetFences(self->device, 1, &self->fence);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "%s: waiting", what);
}

fm_status vulkan_transfer_begin(vulkan *self, fm_error *err)
{
    const VkCommandBufferBeginInfo info = { .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT };
    const VkResult result = vkBeginCommandBuffer(self->transfer_commands, &info);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "vulkan: transfer");
    vulkan_barrier_full(self, self->transfer_commands);
    return FM_OK;
}

fm_status vulkan_transfer_end(vulkan *self, fm_error *err)
{
    vulkan_barrier_full(self, self->transfer_commands);
    return vulkan_submit(self, self->transfer_commands, "vulkan: transfer", err);
}

static fm_status copy(vulkan *self, VkBuffer destination, VkBuffer source,
                      const VkBufferCopy *region, fm_error *err)
{
    const fm_status status = vulkan_transfer_begin(self, err);
    if (status != FM_OK)
        return status;
    vkCmdCopyBuffer(self->transfer_commands, source, destination, 1, region);
    return vulkan_transfer_end(self, err);
}

static uint64_t piece_of(const vulkan *self, uint64_t left)
{
    return left < self->staging->bytes ? left : self->staging->bytes;
}

fm_status vulkan_buffer_write(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                              const void *bytes, uint64_t count, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    fm_status status = FM_OK;
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    if (buffer->mapped != NULL) {
        memcpy((char *)buffer->mapped + offset_bytes, bytes, count);
        return FM_OK;
    }
    for (uint64_t done = 0; done < count && status == FM_OK;) {
        const uint64_t piece = piece_of(self, count - done);
        memcpy(self->staging->mapped, (const char *)bytes + done, piece);
        status = copy(self, buffer->buffer, self->staging->buffer,
                      &(VkBufferCopy){ .dstOffset = offset_bytes + done, .size = piece }, err);
        done += piece;
    }
    return status;
}

fm_status vulkan_buffer_read(fm_device *device, fm_buffer *buffer, uint64_t offset_bytes,
                             void *bytes, uint64_t count, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    assert(offset_bytes <= buffer->bytes && count <= buffer->bytes - offset_bytes);
    if (buffer->mapped != NULL && (buffer->is_cached || count <= UNCACHED_READ_MAX_BYTES)) {
        memcpy(bytes, (const char *)buffer->mapped + offset_bytes, count);
        return FM_OK;
    }
    for (uint64_t done = 0; done < count;) {
        const uint64_t piece = piece_of(self, count - done);
        const fm_status status =
            copy(self, self->staging->buffer, buffer->buffer,
                 &(VkBufferCopy){ .srcOffset = offset_bytes + done, .size = piece }, err);
        if (status != FM_OK)
            return status;
        memcpy((char *)bytes + done, self->staging->mapped, piece);
        done += piece;
    }
    return FM_OK;
}
