/* One pass of a frame: what it binds, and the draw, dispatch or clear that it is. */
#include "instance_internal.h"

#include <string.h>

/* The copy of a resource that this iteration means. */
static fm_slot *current_slot(fm_instance *instance, const built_pass *built, size_t use)
{
    const resource_ref ref = built->refs[use];
    return ref.index < 0 ? built->uses[use].slot : resource_slot(instance, ref);
}

static uint32_t collect_binds(fm_bind binds[FM_MAX_BINDINGS], fm_instance *instance,
                              const built_pass *built)
{
    uint32_t count = 0;
    binds[count++] = (fm_bind){ .binding = SHADER_BINDING_PARAMS,
                                .kind = FM_BINDING_UNIFORM,
                                .buffer = instance->desc.stage->params,
                                .access = FM_ACCESS_READ };
    binds[count++] = (fm_bind){ .binding = SHADER_BINDING_TABLE,
                                .kind = FM_BINDING_UNIFORM,
                                .buffer = instance->table,
                                .access = FM_ACCESS_READ };
    for (size_t i = 0; i < built->use_count; i++) {
        const fm_use *use = &built->uses[i];
        fm_slot *slot = current_slot(instance, built, i);
        const bool writes = (use->access & FM_ACCESS_WRITE) != 0;
        fm_bind *bind = &binds[count++];
        *bind = (fm_bind){ .binding = use->binding,
                           .buffer = slot->buffer,
                           .image = slot->image,
                           .access = use->access };
        if (slot->image != NULL)
            bind->kind = writes ? FM_BINDING_STORAGE_IMAGE : FM_BINDING_SAMPLED;
        else
            bind->kind = slot->by_address ? FM_BINDING_ADDRESS : FM_BINDING_STORAGE;
    }
    if (built->counts)
        binds[count++] = (fm_bind){ .binding = counts_binding(built),
                                    .kind = FM_BINDING_STORAGE,
                                    .buffer = instance->counters,
                                    .access = FM_ACCESS_READ | FM_ACCESS_WRITE };
    return count;
}

static fm_image_resource *current_image(fm_instance *instance, const char *name,
                                        const fm_resource **resource)
{
    const resource_ref ref = resource_find(instance->method, name);
    *resource = &instance->method->resources[ref.index];
    return resource_slot(instance, ref)->image;
}

/* The bits of each channel of an image's clear value: floats, or words of an integer format. */
static void clear_bits(float bits[4], const fm_resource *resource)
{
    static const uint32_t none[4] = { 0 };
    const bool has_words = memcmp(resource->clear_words, none, sizeof none) != 0;
    const void *source = resource->clear_colour;
    if (has_words)
        source = resource->clear_words;
    memcpy(bits, source, sizeof none);
}

static void fill_targets(fm_draw *draw, fm_instance *instance, const fm_pass *pass)
{
    const fm_resource *resource;
    for (uint32_t i = 0; i < FM_MAX_TARGETS && pass->targets[i].resource != NULL; i++) {
        draw->targets[i] = current_image(instance, pass->targets[i].resource, &resource);
        draw->target_loads[i] = pass->targets[i].load;
        clear_bits(draw->target_clears[i], resource);
        draw->target_count = i + 1;
    }
    if (pass->state.depth_stencil == NULL)
        return;
    draw->depth_stencil = current_image(instance, pass->state.depth_stencil, &resource);
    draw->depth_stencil_load = pass->state.depth_stencil_load;
    draw->clear_depth = resource->clear_depth;
    draw->clear_stencil = resource->clear_stencil;
}

static const fm_pipeline *pipeline_at(const built_pass *built, uint32_t iteration)
{
    return built
        ->pipelines[iteration < built->pipeline_count ? iteration : built->pipeline_count - 1];
}

static fm_status draw_pass(fm_instance *instance, size_t index, uint32_t iteration, fm_error *err)
{
    const fm_pass *pass = &instance->method->passes[index];
    const built_pass *built = &instance->passes[index];
    fm_bind binds[FM_MAX_BINDINGS];
    fm_draw draw = { .pipeline = pipeline_at(built, iteration),
                     .binds = binds,
                     .bind_count = collect_binds(binds, instance, built),
                     .width_px = instance->workload.width_px,
                     .height_px = instance->workload.height_px,
                     .vertex_count = 3,
                     .instance_count = 1,
                     .query = -1 };
    fill_targets(&draw, instance, pass);
    if (pass->kind == FM_PASS_SCENE) {
        stage_draw(&draw, instance->desc.stage, pass_geometry(instance, pass));
        for (size_t i = 0; i < instance->total_count; i++)
            if (instance->method->totals[i].resource == NULL &&
                strcmp(instance->method->totals[i].pass, pass->name) == 0)
                draw.query = (int)index;
    }
    return instance->device->ops->draw(instance->device, &draw, err);
}

fm_status pass_dispatch(fm_instance *instance, const fm_pass *pass, const built_pass *built,
                        uint64_t count, fm_error *err)
{
    fm_bind binds[FM_MAX_BINDINGS];
    fm_dispatch dispatch = { .pipeline = pipeline_at(built, 0),
                             .binds = binds,
                             .bind_count = collect_binds(binds, instance, built) };
    if (pass->kind == FM_PASS_INDIRECT) {
        const resource_ref ref = resource_find(instance->method, pass->indirect);
        dispatch.indirect = resource_slot(instance, ref)->buffer;
    } else {
        fm_status status = stage_groups(dispatch.groups, &instance->device->caps, count, err);
        if (status != FM_OK || count == 0)
            return status;
    }
    return instance->device->ops->dispatch(instance->device, &dispatch, err);
}

static void clear_pass(fm_instance *instance, const fm_pass *pass)
{
    fm_device *device = instance->device;
    for (int i = 0; i < FM_MAX_ACCESSES && pass->writes[i] != NULL; i++) {
        const resource_ref ref = resource_find(instance->method, pass->writes[i]);
        const fm_resource *resource = &instance->method->resources[ref.index];
        const fm_slot *slot = resource_slot(instance, ref);
        float bits[4];
        clear_bits(bits, resource);
        if (slot->image != NULL)
            device->ops->image_clear(device, slot->image, bits, resource->clear_depth,
                                     resource->clear_stencil);
        else if (slot->buffer != NULL)
            device->ops->fill(device, slot->buffer, pass->clear_word);
        counts_add_fill(instance, (size_t)ref.index);
    }
}

static bool is_empty_scene(const fm_instance *instance, const fm_pass *pass)
{
    return pass->kind == FM_PASS_SCENE && instance->desc.stage->scene->triangles == 0;
}

fm_status pass_issue(fm_instance *instance, size_t index, uint32_t iteration, fm_error *err)
{
    const fm_pass *pass = &instance->method->passes[index];
    if (pass->kind == FM_PASS_CLEAR) {
        clear_pass(instance, pass);
        return FM_OK;
    }
    if (is_empty_scene(instance, pass) && pass->targets[0].resource == NULL)
        return FM_OK;
    if (instance->passes[index].is_drawn)
        return draw_pass(instance, index, iteration, err);
    return pass_dispatch(instance, pass, &instance->passes[index], pass_invocations(instance, pass),
                         err);
}
