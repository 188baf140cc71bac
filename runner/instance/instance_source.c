/* A pass as GLSL: parameters, declarations, the runner's files, the method's file, main(). */
#include "instance_internal.h"

#include <stdio.h>
#include <string.h>

static void add_fragment_interface(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    if (pass_has_interlock(instance, pass))
        text_add(text, "layout(pixel_interlock_unordered) in;\n");
    if (pass->state.early_tests)
        text_add(text, "layout(early_fragment_tests) in;\n");
    if (pass_is_scene(pass)) {
        text_add(text, "layout(location = 0) flat in uint fm_in_colour;\n"
                       "#ifdef FM_SURVIVAL\n"
                       "layout(location = 1) flat in uint fm_in_layer;\n"
                       "#endif\n"
                       "#ifdef FM_PRIMITIVE\n"
                       "layout(location = 2) flat in uint fm_in_instance;\n"
                       "#endif\n");
    }
    for (uint32_t i = 0; i < FM_MAX_TARGETS && pass->targets[i].resource != NULL; i++) {
        const int index = resource_find(instance->method, pass->targets[i].resource).index;
        text_add(text, "layout(location = %u) out %s fm_target_%s;\n", i,
                 shader_target_type(instance->method->resources[index].format),
                 pass->targets[i].resource);
    }
}

static void add_pixel_main(fm_text *text, const fm_pass *pass, bool drawn)
{
    char name[SHADER_NAME_BYTES];
    shader_name(name, pass->name);
    if (drawn)
        text_add(text, "void main()\n{\n"
                       "#if FM_HELPER_GUARD\n" /* its stores do nothing: what sorts never ends */
                       "    if (gl_HelperInvocation)\n        return;\n"
                       "#endif\n"
                       "    uvec2 pixel = uvec2(gl_FragCoord.xy);\n");
    else
        text_add(
            text,
            "void main()\n{\n"
            "    uint id = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * gl_WorkGroupSize.x)\n"
            "        + gl_GlobalInvocationID.x;\n"
            "    if (id >= uint(FM_PIXELS))\n        return;\n"
            "    uvec2 pixel = uvec2(id %% uint(FM_WIDTH), id / uint(FM_WIDTH));\n");
    if (pass->emits)
        text_add(text, "    fm_emit_begin(pixel);\n    %s(pixel);\n    fm_emit_end(pixel);\n",
                 name);
    else
        text_add(text, "    %s(pixel);\n", name);
    text_add(text, "    fm_tell_cut();\n}\n");
}

static void add_index_main(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    char name[SHADER_NAME_BYTES];
    shader_name(name, pass->name);
    const uint32_t lanes = pass_lanes(instance, pass);
    text_add(text, "void main()\n{\n"
                   "    uint id = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * "
                   "gl_WorkGroupSize.x)\n        + gl_GlobalInvocationID.x;\n");
    if (pass->kind == FM_PASS_TILES || pass->kind == FM_PASS_TRIANGLES)
        text_add(text, "    if (id >= %uu)\n        return;\n",
                 (uint32_t)pass_invocations(instance, pass));
    if (pass->kind == FM_PASS_TOTAL) /* the total travels in the parameter block */
        text_add(text, "    if (id / %uu >= fm_units)\n        return;\n", lanes);
    text_add(text, "    fm_lane = id %% %uu;\n    %s(id / %uu);\n    fm_tell_cut();\n}\n",
             pass->kind == FM_PASS_INDIRECT ? (uint32_t)STAGE_GROUP_SIZE : lanes, name, lanes);
}

static fm_status add_body(fm_text *text, const fm_instance *instance, const fm_pass *pass,
                          bool drawn, fm_error *err)
{
    const fm_shader_folders *folders = &instance->desc.folders;
    const bool reads_triangles = pass_reads_triangles(instance, pass);
    fm_status status = shader_add_file(text, folders, "common/prelude.glsl", err);
    if (status == FM_OK && (pass_is_scene(pass) || reads_triangles) &&
        pass->cover == FM_COVER_NONE && scene_is_layers(instance->desc.stage->scene))
        status = shader_add_file(text, folders, "common/layers.glsl", err);
    if (status == FM_OK && pass->exclusive)
        status = shader_add_file(text, folders, "common/lock_word.glsl", err);
    if (pass->kind != FM_PASS_PIXELS && !pass_is_scene(pass))
        text_add(text, "uint fm_lane;\n");
    if (status == FM_OK && reads_triangles)
        status = shader_add_file(text, folders, "common/triangles.glsl", err);
    if (status == FM_OK && pass->emits)
        status = shader_add_file(text, folders, "common/emit.glsl", err);
    if (status == FM_OK)
        status = shader_add_file(text, folders, pass->shader, err);
    if (status != FM_OK)
        return status;
    if (!pass_is_scene(pass)) {
        if (pass->kind == FM_PASS_PIXELS)
            add_pixel_main(text, pass, drawn);
        else
            add_index_main(text, instance, pass);
        return FM_OK;
    }
    if (!pass_has_interlock(instance, pass))
        status = shader_add_file(text, folders, "common/lock.glsl", err);
    if (status == FM_OK)
        status = shader_add_file(
            text, folders, drawn ? "common/raster_main.glsl" : "common/compute_main.glsl", err);
    return status;
}

static bool any_address(const built_pass *built)
{
    for (size_t i = 0; i < built->use_count; i++)
        if (built->uses[i].slot->by_address)
            return true;
    return false;
}

static bool stores_images(const built_pass *built)
{
    for (size_t i = 0; i < built->use_count; i++)
        if (built->uses[i].slot->format != FM_FORMAT_NONE &&
            (built->uses[i].access & FM_ACCESS_WRITE) != 0)
            return true;
    return false;
}

/* Interlock is the lock's, not the method's; buffers choose how they are reached. */
static uint32_t features_of(const built_pass *built, const fm_instance *instance,
                            const fm_pass *pass)
{
    const uint32_t chosen = FM_FEATURE_INTERLOCK | FM_FEATURE_BUFFER_ADDRESS;
    const uint32_t optional = instance->method->features_optional & instance->device->caps.features;
    uint32_t features = (instance->method->features | optional) & ~chosen;
    if (!built->is_drawn) /* a fragment shader's alone */
        features &= ~(uint32_t)FM_FEATURE_STENCIL_EXPORT;
    if (pass_has_interlock(instance, pass))
        features |= FM_FEATURE_INTERLOCK;
    if (any_address(built))
        features |= FM_FEATURE_BUFFER_ADDRESS;
    return features;
}

fm_status pass_source(fm_text *text, const built_pass *built, const fm_instance *instance,
                      const fm_pass *pass, fm_error *err)
{
    const size_t skipped = built->is_drawn ? built->stage_use_count : 0;
    shader_begin(text, &instance->device->caps, features_of(built, instance, pass));
    if (pass_has_memory_model(instance, pass))
        text_add(text, "#extension GL_KHR_memory_scope_semantics : require\n"
                       "#pragma use_vulkan_memory_model\n");
    shader_define(text, "FM_IMAGES", stores_images(built));
    if (!built->is_drawn)
        text_add(text, "layout(local_size_x = %d) in;\n", STAGE_GROUP_SIZE);
    pass_define(text, instance, pass);
    shader_declare(text, built->uses + skipped, built->use_count - skipped, "pass");
    if (built->is_drawn)
        add_fragment_interface(text, instance, pass);
    return add_body(text, instance, pass, built->is_drawn, err);
}
