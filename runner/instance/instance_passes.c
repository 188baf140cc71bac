/* Passes as data become pipelines. */
#include "instance_internal.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void describe_bindings(fm_pipeline_desc *desc, const built_pass *built)
{
    bool has_table = false;
    desc->bindings[desc->binding_count++] =
        (fm_pipeline_binding){ SHADER_BINDING_PARAMS, FM_BINDING_UNIFORM };
    for (size_t i = 0; i < built->use_count; i++) {
        const fm_use *use = &built->uses[i];
        has_table = has_table || use->slot->in_table;
        if (use->slot->by_address)
            continue;
        const fm_binding_kind kind = use->slot->format == FM_FORMAT_NONE ? FM_BINDING_STORAGE
                                     : (use->access & FM_ACCESS_WRITE) != 0
                                         ? FM_BINDING_STORAGE_IMAGE
                                         : FM_BINDING_SAMPLED;
        desc->bindings[desc->binding_count++] = (fm_pipeline_binding){ use->binding, kind };
    }
    if (has_table)
        desc->bindings[desc->binding_count++] =
            (fm_pipeline_binding){ SHADER_BINDING_TABLE, FM_BINDING_UNIFORM };
}

static uint32_t image_samples(const fm_instance *instance, const char *name, fm_format *format)
{
    const fm_resource *resource =
        &instance->method->resources[resource_find(instance->method, name).index];
    *format = resource->format;
    return resource_samples(instance, resource);
}

static void describe_targets(fm_pipeline_desc *desc, const fm_instance *instance,
                             const fm_pass *pass)
{
    desc->state = pass->state;
    for (uint32_t i = 0; i < FM_MAX_TARGETS && pass->targets[i].resource != NULL; i++) {
        fm_target_desc *target = &desc->targets[desc->target_count++];
        desc->samples = image_samples(instance, pass->targets[i].resource, &target->format);
        target->blend = pass->targets[i].blend;
        target->no_write = pass->targets[i].no_write;
    }
    if (pass->state.depth_stencil != NULL)
        desc->samples = image_samples(instance, pass->state.depth_stencil, &desc->depth_stencil);
}

static fm_status vertex_source(fm_text *text, const built_pass *built, const fm_instance *instance,
                               const fm_pass *pass, fm_error *err)
{
    const fm_shader_folders *folders = &instance->desc.folders;
    if (pass_is_scene(pass))
        return stage_vertex_shader(text, built->uses, built->stage_use_count, instance->desc.stage,
                                   folders, pass_geometry(instance, pass), err);
    shader_begin(text, &instance->device->caps, 0);
    return shader_add_file(text, folders, "common/full_screen_vertex.glsl", err);
}

static uint32_t pipeline_count(const fm_instance *instance, const fm_pass *pass)
{
    const fm_loop *innermost = NULL;
    int narrowest = FM_MAX_PASSES;
    if (pass->state.stencil_reference_step == 0 && pass->state.sample_mask_step == 0)
        return 1;
    for (int i = 0; i < FM_MAX_LOOPS && instance->method->loops[i].first != NULL; i++) {
        const fm_loop *loop = &instance->method->loops[i];
        const int at = (int)(pass - instance->method->passes);
        const int first = pass_index(instance->method, loop->first);
        const int last = pass_index(instance->method, loop->last);
        if (at < first || last < at || last - first >= narrowest)
            continue;
        innermost = loop;
        narrowest = last - first;
    }
    const uint32_t count = innermost != NULL ? formula_count(innermost, &instance->workload) : 0;
    return count > 0 ? count : 1;
}

static void destroy_pipelines(built_pass *built, const fm_instance *instance)
{
    for (uint32_t i = 0; built->pipelines != NULL && i < built->pipeline_count; i++)
        instance->device->ops->pipeline_destroy(instance->device, built->pipelines[i]);
    free(built->pipelines);
    built->pipelines = NULL;
}

/* One pipeline, or one an iteration. */
static fm_status compile(built_pass *built, const fm_instance *instance, fm_pipeline_desc *desc,
                         fm_error *err)
{
    fm_status status = FM_OK;
    built->pipelines = calloc(built->pipeline_count, sizeof(fm_pipeline *));
    if (built->pipelines == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: pipelines", desc->name);
    for (uint32_t i = 0; i < built->pipeline_count && status == FM_OK; i++) {
        desc->iteration = i;
        status = instance->device->ops->pipeline_create(&built->pipelines[i], instance->device,
                                                        desc, err);
    }
    return status;
}

/* A pass whose accesses cannot be counted is built without, and the instance says why. */
static fm_status compile_counting(built_pass *built, fm_instance *instance, fm_pipeline_desc *desc,
                                  fm_error *err)
{
    pass_counting counting;
    fm_error refusal = { 0 };
    if (!counts_describe(&counting, instance, built))
        return compile(built, instance, desc, err);
    built->counts = built->use_count < INSTANCE_USES_MAX;
    fm_pipeline_desc counted = *desc;
    counted.counting = &counting.desc;
    if (built->counts)
        counted.bindings[counted.binding_count++] =
            (fm_pipeline_binding){ counts_binding(built), FM_BINDING_STORAGE };
    fm_status status = built->counts
                           ? compile(built, instance, &counted, &refusal)
                           : fm_refuse(&refusal, FM_REASON_SUITE_LIMIT,
                                       "%s: no binding is left to count accesses", desc->name);
    if (status != FM_UNSUPPORTED) {
        if (status != FM_OK && err != NULL)
            *err = refusal;
        return status;
    }
    snprintf(instance->uncounted, sizeof instance->uncounted, "%.255s", refusal.message);
    destroy_pipelines(built, instance);
    built->counts = false;
    return compile(built, instance, desc, err);
}

static fm_status create_pipelines(built_pass *built, fm_instance *instance, const fm_pass *pass,
                                  fm_error *err)
{
    char name[160];
    fm_text source = { 0 }, vertex = { 0 };
    fm_pipeline_desc desc = { .name = name };
    snprintf(name, sizeof name, "%s: pass '%s'", instance->method->id, pass->name);
    fm_status status = pass_source(&source, built, instance, pass, err);
    if (status == FM_OK && built->is_drawn)
        status = vertex_source(&vertex, built, instance, pass, err);
    if (status != FM_OK)
        goto out;
    desc.compute = built->is_drawn ? NULL : source.bytes;
    desc.fragment = built->is_drawn ? source.bytes : NULL;
    desc.vertex = vertex.bytes;
    describe_bindings(&desc, built);
    if (built->is_drawn) {
        describe_targets(&desc, instance, pass);
        if (pass_is_scene(pass))
            stage_vertex_layout(&desc, instance->desc.stage, pass_geometry(instance, pass));
    }
    built->pipeline_count = pipeline_count(instance, pass);
    status = compile_counting(built, instance, &desc, err);
out:
    text_free(&source);
    text_free(&vertex);
    return status;
}

static fm_status build_pass(built_pass *built, fm_instance *instance, const fm_pass *pass,
                            fm_error *err)
{
    *built = (built_pass){ .is_drawn = pass_is_drawn(instance, pass) };
    if (pass->kind == FM_PASS_HOST || pass->kind == FM_PASS_CLEAR)
        return FM_OK;
    if (pass->cover != FM_COVER_NONE) {
        const fm_status status =
            stage_create_cover(instance->desc.stage, pass_geometry(instance, pass), err);
        if (status != FM_OK)
            return status;
    }
    pass_collect_uses(built, instance, pass);
    if (built->is_overfull)
        return fm_refuse(err, FM_REASON_SUITE_LIMIT,
                         "%s: pass '%s': more than %d resources, the feed's own included",
                         instance->method->id, pass->name, INSTANCE_USES_MAX);
    return create_pipelines(built, instance, pass, err);
}

const fm_pass instance_combine = { .name = "combine",
                                   .kind = FM_PASS_PIXELS,
                                   .shader = "common/combine.glsl" };
const fm_pass instance_hash = { .name = "image_hash",
                                .kind = FM_PASS_TILES,
                                .shader = "common/image_hash.glsl" };

/* A pass of the runner's own, over the image. */
static fm_status build_own(built_pass *built, fm_instance *instance, const fm_pass *pass,
                           fm_error *err)
{
    const bool combines = pass == &instance_combine;
    *built = (built_pass){ 0 };
    pass_collect_uses(built, instance, pass);
    pass_use_stage(built, instance, STAGE_OUTPUT,
                   combines ? FM_ACCESS_READ | FM_ACCESS_WRITE : FM_ACCESS_READ);
    if (combines)
        pass_use_stage(built, instance, STAGE_OUTPUT_BACK, FM_ACCESS_READ);
    for (size_t i = 0; i < built->use_count; i++)
        built->uses[i].binding = SHADER_BINDING_FIRST + (uint32_t)i;
    return create_pipelines(built, instance, pass, err);
}

fm_status passes_create(fm_instance *instance, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->pass_count && status == FM_OK; i++)
        if (!pass_is_left_out(instance, &instance->method->passes[i]))
            status = build_pass(&instance->passes[i], instance, &instance->method->passes[i], err);
    if (status == FM_OK && instance->emits_back && !instance->desc.is_capture)
        status = build_own(&instance->combine, instance, &instance_combine, err);
    if (status == FM_OK && instance->desc.hashes_image)
        status = build_own(&instance->hash, instance, &instance_hash, err);
    return status;
}

static void destroy_pass(fm_instance *instance, built_pass *built)
{
    destroy_pipelines(built, instance);
    *built = (built_pass){ 0 };
}

void passes_destroy(fm_instance *instance)
{
    for (size_t i = 0; i < instance->pass_count; i++)
        destroy_pass(instance, &instance->passes[i]);
    destroy_pass(instance, &instance->combine);
    destroy_pass(instance, &instance->hash);
}
