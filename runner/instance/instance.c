#include "instance_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *workload_option(const fm_workload *workload, const char *name)
{
    const fm_instance *instance = workload->runner;
    return option_chosen(instance->method, name, instance->choices, instance->choice_count);
}

static const struct feature_words {
    uint32_t feature;
    const char *words;
} feature_words[] = {
    { FM_FEATURE_INT64_ATOMICS, "64-bit atomics on buffers" },
    { FM_FEATURE_INTERLOCK, "fragment shader interlock" },
    { FM_FEATURE_STENCIL_EXPORT, "stencil values from shaders" },
    { FM_FEATURE_BUFFER_ADDRESS, "buffer addresses" },
    { FM_FEATURE_SUBGROUP_BALLOT, "subgroup ballots" },
};

static fm_status need(const fm_instance *instance, uint32_t features, fm_error *err)
{
    const uint32_t missing = features & ~instance->device->caps.features;
    for (size_t i = 0; i < sizeof feature_words / sizeof feature_words[0]; i++)
        if ((missing & feature_words[i].feature) != 0)
            return fm_refuse(err, FM_REASON_FEATURE, "%s needs %s, which %s does not have",
                             instance->method->id, feature_words[i].words,
                             instance->device->caps.name);
    return FM_OK;
}

static bool any_exclusive(const fm_method_desc *method)
{
    for (int i = 0; i < FM_MAX_PASSES && method->passes[i].name != NULL; i++)
        if (method->passes[i].exclusive)
            return true;
    return false;
}

static fm_status check_device(fm_instance *instance, fm_error *err)
{
    const fm_method_desc *method = instance->method;
    const fm_device_caps *caps = &instance->device->caps;
    fm_status status = need(instance, method->features, err);
    if (status == FM_OK && any_exclusive(method) && !instance->is_spin_locked) {
        status = need(instance, FM_FEATURE_INTERLOCK, err);
        if (status == FM_OK && instance->desc.stage->feed != FM_FEED_RASTER)
            status = fm_refuse(err, FM_REASON_SETTING,
                               "lock=interlock: only fragment shaders have an interlock");
    }
    for (size_t i = 0; i < instance->resource_count && status == FM_OK; i++) {
        const fm_resource *resource = &method->resources[i];
        const bool is_depth =
            resource->format == FM_FORMAT_D32F || resource->format == FM_FORMAT_D32F_S8;
        const uint32_t possible = is_depth ? caps->depth_samples : caps->colour_samples;
        const uint32_t samples = resource_samples(instance, resource);
        if (samples > 1 && (samples >= 32 || (possible >> samples & 1u) == 0))
            status = fm_refuse(err, FM_REASON_DEVICE_LIMIT,
                               "%s: resource '%s' has %u samples, which %s "
                               "does not have",
                               method->id, resource->name, samples, caps->name);
    }
    return status;
}

static void name_slots(fm_instance *instance)
{
    uint32_t line = STAGE_SLOT_COUNT;
    for (size_t i = 0; i < instance->resource_count; i++) {
        const fm_resource *resource = &instance->method->resources[i];
        snprintf(instance->previous_names[i], sizeof instance->previous_names[i], "%s_previous",
                 resource->name);
        for (int copy = 0; copy < (resource->ping_pong ? 2 : 1); copy++) {
            fm_slot *slot = &instance->resources[i][copy];
            slot->name = copy == 0 ? resource->name : instance->previous_names[i];
            slot->type = shader_element_type(resource->element);
            slot->format = resource->kind == FM_RESOURCE_IMAGE ? resource->format : FM_FORMAT_NONE;
            slot->in_table = resource->kind == FM_RESOURCE_BUFFER;
            slot->table_index = line++;
        }
    }
    instance->locks =
        (fm_slot){ .name = "fm_locks", .type = "uint", .in_table = true, .table_index = line };
}

size_t instance_choices(fm_choice all[FM_MAX_OPTIONS], const fm_instance_desc *desc)
{
    const fm_device_caps *caps = &desc->stage->device->caps;
    fm_auto_case of = auto_case(desc->method, desc->settings, desc->stage->n);
    of.width_px = desc->stage->scene->width_px; /* as it is, whatever settings say */
    of.height_px = desc->stage->scene->height_px;
    const fm_auto_device device = { .is_software = caps->is_software,
                                    .image_layers = caps->image_layers,
                                    .image_max_bytes = caps->image_max_bytes };
    return auto_choices(all, desc->choices, desc->choice_count, &of, &device);
}

static void choose(fm_instance *instance, const fm_instance_desc *desc)
{
    instance->choice_count = instance_choices(instance->choices, desc);
    method_choose(&instance->chosen, desc->method, instance->choices, instance->choice_count);
    instance->method = &instance->chosen;
}

static void fill_workload(fm_instance *instance, const fm_instance_desc *desc)
{
    const fm_scene *scene = desc->stage->scene;
    instance->workload = (fm_workload){
        .width_px = scene->width_px,
        .height_px = scene->height_px,
        .k = desc->settings->k,
        .n = desc->stage->n,
        .triangles = scene->triangles,
        .fragments = desc->fragments,
        .fragments_kept = desc->fragments_kept,
        .totals = instance->totals,
        .option = workload_option,
        .runner = instance,
    };
}

fm_status instance_create(fm_instance **out, const fm_instance_desc *desc, fm_error *err)
{
    const fm_buffer_desc table = { .name = "table",
                                   .bytes = SHADER_TABLE_LINES * sizeof(fm_table_line),
                                   .owner = FM_OWNER_RUNNER,
                                   .is_uniform = true };
    fm_instance *instance = calloc(1, sizeof *instance);
    *out = NULL;
    if (instance == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", desc->method->id);
    instance->desc = *desc;
    choose(instance, desc);
    instance->device = desc->stage->device;
    instance->is_spin_locked = any_exclusive(desc->method) && desc->settings->lock == FM_LOCK_SPIN;
    instance->emits_back = (desc->method->traits & FM_TRAIT_EMITS_BACK) != 0;
    instance->pass_count = pass_count(instance->method);
    instance->resource_count = resource_count(instance->method);
    instance->total_count = total_count(instance->method);
    fill_workload(instance, desc);
    name_slots(instance);
    fm_status status = check_device(instance, err);
    if (status == FM_OK)
        status =
            instance->device->ops->buffer_create(&instance->table, instance->device, &table, err);
    if (status == FM_OK)
        status = counts_create(instance, err);
    if (status == FM_OK && instance->emits_back && !desc->is_capture)
        status = stage_create_back(desc->stage, err);
    if (status == FM_OK)
        status = resources_create_fixed(instance, err);
    if (status == FM_OK)
        status = passes_create(instance, err);
    if (status == FM_OK)
        *out = instance;
    else
        instance_destroy(instance);
    return status;
}

void instance_destroy(fm_instance *instance)
{
    if (instance == NULL)
        return;
    passes_destroy(instance);
    resources_destroy(instance);
    instance->device->ops->buffer_destroy(instance->device, instance->counters);
    instance->device->ops->buffer_destroy(instance->device, instance->table);
    free(instance);
}

uint64_t instance_k_chosen(const fm_instance *instance)
{
    const int total = total_index(instance->method, instance->method->k_total);
    return total >= 0 ? instance->totals[total] : 0;
}

void instance_tell_fragments(fm_instance *instance, uint64_t fragments)
{
    instance->workload.fragments = fragments;
}

fm_slot *instance_slot(fm_instance *instance, const char *name)
{
    const resource_ref ref = resource_find(instance->method, name);
    return ref.index >= 0 ? &instance->resources[ref.index][0] : NULL;
}
