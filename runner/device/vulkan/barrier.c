#include "context.h"

static const VkAccessFlags2 all_writes =
    VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT | VK_ACCESS_2_COLOR_ATTACHMENT_WRITE_BIT |
    VK_ACCESS_2_DEPTH_STENCIL_ATTACHMENT_WRITE_BIT | VK_ACCESS_2_TRANSFER_WRITE_BIT;

VkMemoryBarrier2 vulkan_barrier_begin(void)
{
    return (VkMemoryBarrier2){ .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2 };
}

/* Is the last write visible to this access already? */
static bool is_visible(const vulkan_access *access, VkPipelineStageFlags2 stages,
                       VkAccessFlags2 accesses)
{
    return access->write_stages == 0 ||
           ((stages & ~access->visible_stages) == 0 && (accesses & ~access->visible_access) == 0);
}

void vulkan_barrier_add(VkMemoryBarrier2 *barrier, vulkan_access *access, uint64_t epoch,
                        VkPipelineStageFlags2 stages, VkAccessFlags2 accesses)
{
    const VkAccessFlags2 writes = accesses & all_writes;
    if (access->epoch != epoch)
        *access = (vulkan_access){ .epoch = epoch };
    const VkPipelineStageFlags2 before =
        writes != 0 ? access->write_stages | access->read_stages
                    : (is_visible(access, stages, accesses) ? 0 : access->write_stages);
    if (before != 0) {
        barrier->srcStageMask |= before;
        barrier->srcAccessMask |= access->write_access;
        barrier->dstStageMask |= stages;
        barrier->dstAccessMask |= accesses;
        access->visible_stages = stages;
        access->visible_access = accesses;
    }
    if (writes != 0)
        *access = (vulkan_access){ .epoch = epoch, .write_stages = stages, .write_access = writes };
    else
        access->read_stages |= stages;
}

static VkAccessFlags2 accesses_of(const fm_bind *bind)
{
    VkAccessFlags2 accesses = 0;
    switch (bind->kind) {
    case FM_BINDING_UNIFORM:
        return bind->access != 0 ? VK_ACCESS_2_UNIFORM_READ_BIT : 0;
    case FM_BINDING_SAMPLED:
        return bind->access != 0 ? VK_ACCESS_2_SHADER_SAMPLED_READ_BIT : 0;
    case FM_BINDING_STORAGE:
    case FM_BINDING_ADDRESS:
    case FM_BINDING_STORAGE_IMAGE:
        if ((bind->access & FM_ACCESS_READ) != 0)
            accesses |= VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
        if ((bind->access & FM_ACCESS_WRITE) != 0)
            accesses |= VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;
        return accesses;
    }
    return 0;
}

void vulkan_barrier_add_binds(VkMemoryBarrier2 *barrier, uint64_t epoch, const fm_bind *binds,
                              uint32_t count, VkPipelineStageFlags2 stages)
{
    for (uint32_t i = 0; i < count; i++) {
        vulkan_access *access =
            binds[i].buffer != NULL ? &binds[i].buffer->access : &binds[i].image->access;
        const VkAccessFlags2 accesses = accesses_of(&binds[i]);
        if (accesses != 0)
            vulkan_barrier_add(barrier, access, epoch, stages, accesses);
    }
}

void vulkan_barrier_record(VkCommandBuffer commands, const VkMemoryBarrier2 *barrier)
{
    const VkDependencyInfo info = { .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO,
                                    .memoryBarrierCount = 1,
                                    .pMemoryBarriers = barrier };
    if (barrier->srcStageMask != 0)
        vkCmdPipelineBarrier2(commands, &info);
}

void vulkan_barrier_full(vulkan *self, VkCommandBuffer commands)
{
    const VkMemoryBarrier2 barrier = {
        .sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
        .srcStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
        .srcAccessMask = VK_ACCESS_2_MEMORY_WRITE_BIT,
        .dstStageMask = VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT | VK_PIPELINE_STAGE_2_HOST_BIT,
        .dstAccessMask =
            VK_ACCESS_2_MEMORY_READ_BIT | VK_ACCESS_2_MEMORY_WRITE_BIT | VK_ACCESS_2_HOST_READ_BIT,
    };
    vulkan_barrier_record(commands, &barrier);
    self->epoch++;
}
