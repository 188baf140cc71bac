#include <assert.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "context.h"

static fm_status create_pool(vulkan_query_pool *queries, const vulkan *self, VkQueryType type,
                             uint32_t capacity, fm_error *err)
{
    const VkQueryPoolCreateInfo info = { .sType = VK_STRUCTURE_TYPE_QUERY_POOL_CREATE_INFO,
                                         .queryType = type,
                                         .queryCount = capacity };
    queries->slot = calloc(capacity, sizeof queries->slot[0]);
    if (queries->slot == NULL)
        return fm_fail(err, FM_NO_MEMORY, "vulkan: %u queries", capacity);
    const VkResult result = vkCreateQueryPool(self->device, &info, NULL, &queries->pool);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "vulkan: query pool");
    vkResetQueryPool(self->device, queries->pool, 0, capacity);
    queries->capacity = capacity;
    return FM_OK;
}

fm_status vulkan_queries_create(vulkan *self, fm_error *err)
{
    const fm_status status =
        create_pool(&self->timestamps, self, VK_QUERY_TYPE_TIMESTAMP, VULKAN_TIMESTAMPS_MAX, err);
    if (status != FM_OK)
        return status;
    return create_pool(&self->occlusions, self, VK_QUERY_TYPE_OCCLUSION, VULKAN_OCCLUSIONS_MAX,
                       err);
}

static void destroy_pool(const vulkan *self, vulkan_query_pool *queries)
{
    if (!self->has_hung)
        vkDestroyQueryPool(self->device, queries->pool, NULL);
    free(queries->slot);
}

void vulkan_queries_destroy(vulkan *self)
{
    destroy_pool(self, &self->timestamps);
    destroy_pool(self, &self->occlusions);
}

fm_status vulkan_frame_begin(fm_device *device, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    const VkCommandBufferBeginInfo info = { .sType = VK_STRUCTURE_TYPE_COMMAND_BUFFER_BEGIN_INFO,
                                            .flags = VK_COMMAND_BUFFER_USAGE_ONE_TIME_SUBMIT_BIT };
    self->frame_start_ns = clock_ns();
    self->timers_overflowed = false;
    const fm_status status = vulkan_bind_reset(self, err);
    if (status != FM_OK)
        return status;
    const VkResult result = vkBeginCommandBuffer(self->frame_commands, &info);
    if (result != VK_SUCCESS)
        return vulkan_fail(err, result, "vulkan: frame");
    vulkan_barrier_full(self, self->frame_commands); /* what earlier frames and transfers wrote */
    return FM_OK;
}

static fm_status read_results(uint64_t *results, const vulkan *self,
                              const vulkan_query_pool *queries, fm_error *err)
{
    const VkResult result = vkGetQueryPoolResults(self->device, queries->pool, 0, queries->count,
                                                  queries->count * sizeof results[0], results,
                                                  sizeof results[0], VK_QUERY_RESULT_64_BIT);
    return result == VK_SUCCESS ? FM_OK : vulkan_fail(err, result, "vulkan: reading queries");
}

static void add_timers(fm_frame_times *times, const vulkan *self, const uint64_t *ticks)
{
    const double tick_ns = self->base.caps.timestamp_ns;
    for (uint32_t i = 0; i + 1 < self->timestamps.count; i += 2) {
        const uint64_t span = (ticks[i + 1] - ticks[i]) & self->timestamp_mask;
        times->timer_ns[self->timestamps.slot[i]] += (uint64_t)((double)span * tick_ns + 0.5);
    }
}

static fm_status collect(fm_frame_times *times, const vulkan *self, fm_error *err)
{
    fm_status status = FM_OK;
    uint64_t *results = malloc(VULKAN_TIMESTAMPS_MAX * sizeof results[0]);
    _Static_assert((int)VULKAN_OCCLUSIONS_MAX <= (int)VULKAN_TIMESTAMPS_MAX, "room for either");
    if (results == NULL)
        return fm_fail(err, FM_NO_MEMORY, "vulkan: query results");
    if (self->timestamps.count > 0) {
        status = read_results(results, self, &self->timestamps, err);
        if (status == FM_OK)
            add_timers(times, self, results);
    }
    if (status == FM_OK && self->occlusions.count > 0) {
        status = read_results(results, self, &self->occlusions, err);
        for (uint32_t i = 0; status == FM_OK && i < self->occlusions.count; i++)
            times->query[self->occlusions.slot[i]] += results[i];
    }
    free(results);
    return status;
}

static void reset(const vulkan *self, vulkan_query_pool *queries)
{
    if (queries->count > 0)
        vkResetQueryPool(self->device, queries->pool, 0, queries->count);
    queries->count = 0;
}

fm_status vulkan_frame_end(fm_device *device, fm_frame_times *times, fm_error *err)
{
    vulkan *self = (vulkan *)device;
    *times = (fm_frame_times){ .wall_ns = 0 };
    vulkan_barrier_full(self, self->frame_commands); /* for the host's reads */
    fm_status status = vulkan_submit(self, self->frame_commands, "vulkan: frame", err);
    times->wall_ns = clock_ns() - self->frame_start_ns;
    if (self->has_hung)
        return status;
    if (status == FM_OK)
        status = collect(times, self, err);
    reset(self, &self->timestamps);
    reset(self, &self->occlusions);
    if (status == FM_OK && self->timers_overflowed)
        status =
            fm_refuse(err, FM_REASON_SUITE_LIMIT, "vulkan: more than %d timed intervals in a frame",
                      VULKAN_TIMESTAMPS_MAX / 2);
    return status;
}

/* A full barrier on both sides: software drivers write a timestamp at their next flush, and work
 * that follows it would be counted before it. */
static void take_timestamp(vulkan *self, uint32_t timer)
{
    const uint32_t index = self->timestamps.count++;
    self->timestamps.slot[index] = (uint8_t)timer;
    vulkan_barrier_full(self, self->frame_commands);
    vkCmdWriteTimestamp2(self->frame_commands, VK_PIPELINE_STAGE_2_ALL_COMMANDS_BIT,
                         self->timestamps.pool, index);
    vulkan_barrier_full(self, self->frame_commands);
}

void vulkan_timer_begin(fm_device *device, uint32_t timer)
{
    vulkan *self = (vulkan *)device;
    assert(timer < FM_MAX_TIMERS);
    if (self->no_timers || self->timers_overflowed)
        return;
    if (self->timestamps.count + 2 > self->timestamps.capacity) {
        self->timers_overflowed = true;
        return;
    }
    take_timestamp(self, timer);
}

void vulkan_timer_end(fm_device *device, uint32_t timer)
{
    vulkan *self = (vulkan *)device;
    assert(timer < FM_MAX_TIMERS);
    if (!self->no_timers && !self->timers_overflowed)
        take_timestamp(self, timer);
}
