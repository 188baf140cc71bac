/* Buffers of a stage: storage behind slots, vertices and indices. */
#include <inttypes.h>
#include <stdlib.h>

#include "stage.h"

enum { INDICES_PER_QUAD = 6, CORNERS_PER_QUAD = 4 };

fm_status slot_create_buffer(fm_slot *slot, fm_device *device, fm_buffers buffers,
                             const fm_buffer_desc *desc, fm_error *err)
{
    const bool has_address = (device->caps.features & FM_FEATURE_BUFFER_ADDRESS) != 0;
    fm_buffer_desc chosen = *desc;
    chosen.by_address =
        buffers == FM_BUFFERS_ADDRESS || (buffers == FM_BUFFERS_AUTO && has_address &&
                                          desc->bytes > device->caps.storage_range_bytes);
    slot->by_address = chosen.by_address;
    return device->ops->buffer_create(&slot->buffer, device, &chosen, err);
}

void slot_destroy(fm_slot *slot, fm_device *device)
{
    device->ops->buffer_destroy(device, slot->buffer);
    device->ops->image_destroy(device, slot->image);
    slot->buffer = NULL;
    slot->image = NULL;
}

static fm_status create_filled(fm_buffer **buffer, fm_device *device, const fm_buffer_desc *desc,
                               const void *data, fm_error *err)
{
    fm_status status = device->ops->buffer_create(buffer, device, desc, err);
    if (status == FM_OK && data != NULL)
        status = device->ops->buffer_write(device, *buffer, 0, data, desc->bytes, err);
    return status;
}

fm_status stage_create_vertices(fm_buffer **buffer, fm_device *device, const void *vertices,
                                uint64_t bytes, fm_error *err)
{
    const fm_buffer_desc desc = {
        .name = "vertices", .bytes = bytes, .owner = FM_OWNER_RUNNER, .is_vertex = true
    };
    return create_filled(buffer, device, &desc, vertices, err);
}

fm_status stage_create_indices(fm_buffer **buffer, fm_device *device, const uint32_t *indices,
                               uint64_t count, fm_error *err)
{
    const fm_buffer_desc desc = { .name = "indices",
                                  .bytes = count * sizeof *indices,
                                  .owner = FM_OWNER_RUNNER,
                                  .is_index = true };
    return create_filled(buffer, device, &desc, indices, err);
}

fm_status stage_create_quad_indices(fm_buffer **buffer, fm_device *device, uint32_t quads,
                                    fm_error *err)
{
    static const uint32_t corner[INDICES_PER_QUAD] = { 0, 1, 2, 2, 1, 3 };
    const uint64_t count = (uint64_t)quads * INDICES_PER_QUAD;
    uint32_t *indices = malloc(count * sizeof *indices);
    if (indices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%" PRIu64 " indices", count);
    for (uint64_t i = 0; i < count; i++)
        indices[i] =
            (uint32_t)(i / INDICES_PER_QUAD) * CORNERS_PER_QUAD + corner[i % INDICES_PER_QUAD];
    fm_status status = stage_create_indices(buffer, device, indices, count, err);
    free(indices);
    return status;
}
