/* A pass as GLSL: parameters, declarations, the runner's files, the method's file, main(). */
#include "instance_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <string.h>

#include "plugin/culling.h"

/* Spins until a lock is given up and the fragment counted as lost: bounded, since a hung GPU helps
 * nobody. In Mesa's software a try costs an iteration of the spin and one of each loop in store(),
 * taken or not, out of 65 535 for all: where they end, a store ends half way and nobody knows.
 * Three loops in store() fit. */
enum { SPIN_MAX = 1 << 20, SPIN_MAX_SOFTWARE = 16000 };

static bool has_interlock(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && !instance->is_spin_locked;
}

/* ---- defines ---- */

static void glsl_name(char name[64], const char *text)
{
    size_t i = 0;
    for (; text[i] != '\0' && i < 63; i++)
        name[i] = isalnum((unsigned char)text[i]) ? text[i] : '_';
    name[i] = '\0';
}

static void upper(char *name)
{
    for (; *name != '\0'; name++)
        *name = (char)toupper((unsigned char)*name);
}

static void define_option(fm_text *text, const fm_option *option, const char *value)
{
    char name[64], value_name[64];
    uint64_t number = 0;
    bool is_number = true;
    glsl_name(name, option->name);
    upper(name);
    for (int i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++)
        is_number = is_number && text_to_u64(&number, option->values[i]);
    if (is_number && text_to_u64(&number, value)) {
        shader_define(text, name, number);
        return;
    }
    for (int i = 0; i < FM_MAX_OPTION_VALUES && option->values[i] != NULL; i++) {
        glsl_name(value_name, option->values[i]);
        upper(value_name);
        text_add(text, "#define %s_%s %d\n", name, value_name, i);
        if (strcmp(option->values[i], value) == 0)
            shader_define(text, name, (uint64_t)i);
    }
}

/* The first pass that emits starts the picture. */
static bool emits_first(const fm_instance *instance, const fm_pass *pass)
{
    for (const fm_pass *before = instance->method->passes; before < pass; before++)
        if (before->emits && !pass_is_left_out(instance, before))
            return false;
    return true;
}

static bool release_exchanges(const fm_instance *instance)
{
    switch (instance->desc.settings->release) {
    case FM_RELEASE_AUTO:
        break;
    case FM_RELEASE_STORE:
        return false;
    case FM_RELEASE_EXCHANGE:
        return true;
    }
    return instance->device->caps.needs_lock_barriers;
}

static void define_all(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    const fm_device_caps *caps = &instance->device->caps;
    stage_define(text, instance->desc.stage, pass_geometry(instance, pass));
    shader_define(text, "K", instance->workload.k > 0 ? instance->workload.k : 1);
    shader_define(text, "N", instance->workload.n > 0 ? instance->workload.n : 1);
    shader_define(text, "FM_SPIN_MAX", caps->loop_limit > 0 ? SPIN_MAX_SOFTWARE : SPIN_MAX);
    shader_define(text, "FM_LOCK_EXCHANGE", release_exchanges(instance));
    shader_define(text, "FM_EXCLUSIVE", pass->exclusive && instance->is_spin_locked);
    shader_define(text, "FM_INTERLOCK", has_interlock(instance, pass));
    shader_define(text, "FM_TARGETS", pass_has_fixed_function(pass));
    shader_define(text, "FM_EMIT_FIRST", emits_first(instance, pass));
    culling_define(text, pass, instance->desc.settings);
    shader_define(text, "FM_GROUP_LANES", FM_GROUP_LANES);
    shader_define(text, "FM_LOOP_LIMIT", caps->loop_limit);
    shader_define(text, "FM_SUBGROUP_SIZE", caps->subgroup_size);
    shader_define(text, "FM_NARROW", instance_is_narrow(instance));
    shader_define_features(text, instance->method->features_optional, caps->features);
    if (instance->emits_back)
        shader_define(text, "FM_EMITS_BACK", 1);
    if (instance->desc.is_capture) {
        shader_define(text, "FM_CAPTURE", 1);
        shader_define(text, "FM_IS_STORE", pass->name != NULL && strcmp(pass->name, "store") == 0);
        shader_define(text, "FM_CAPTURE_SLOTS", instance->desc.capture_slots);
    }
    if (instance->desc.wants_primitive && pass_is_scene(pass)) {
        fm_draw draw = { 0 };
        stage_draw(&draw, instance->desc.stage, pass_geometry(instance, pass));
        shader_define(text, "FM_PRIMITIVE", 1);
        shader_define(text, "FM_INSTANCE_TRIANGLES", draw.vertex_count / 3);
        text_add(text, "uint fm_primitive;\n");
    }
    for (int i = 0; i < FM_MAX_OPTIONS && instance->method->options[i].name != NULL; i++)
        define_option(text, &instance->method->options[i],
                      option_chosen(instance->method, instance->method->options[i].name,
                                    instance->desc.choices, instance->desc.choice_count));
}

/* ---- sources ---- */

static void add_fragment_interface(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    if (has_interlock(instance, pass))
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
        bool is_previous;
        const int index = resource_index(instance->method, pass->targets[i].resource, &is_previous);
        text_add(text, "layout(location = %u) out %s fm_target_%s;\n", i,
                 shader_target_type(instance->method->resources[index].format),
                 pass->targets[i].resource);
    }
}

static void add_pixel_main(fm_text *text, const fm_pass *pass, bool drawn)
{
    char name[64];
    glsl_name(name, pass->name);
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
        text_add(text, "    fm_emit_begin(pixel);\n    %s(pixel);\n    fm_emit_end(pixel);\n}\n",
                 name);
    else
        text_add(text, "    %s(pixel);\n}\n", name);
}

static void add_index_main(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    char name[64];
    glsl_name(name, pass->name);
    const uint32_t lanes = pass_lanes(instance, pass);
    text_add(text, "void main()\n{\n"
                   "    uint id = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * "
                   "gl_WorkGroupSize.x)\n        + gl_GlobalInvocationID.x;\n");
    if (pass->kind == FM_PASS_TILES || pass->kind == FM_PASS_TRIANGLES)
        text_add(text, "    if (id >= %uu)\n        return;\n",
                 (uint32_t)pass_invocations(instance, pass));
    if (pass->kind == FM_PASS_TOTAL) /* the total travels in the parameter block */
        text_add(text, "    if (id / %uu >= fm_band_first)\n        return;\n", lanes);
    text_add(text, "    fm_lane = id %% %uu;\n    %s(id / %uu);\n}\n",
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
    if (!has_interlock(instance, pass))
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

/* Interlock is the lock's, not the method's; buffers choose how they are reached. */
static uint32_t features_of(const built_pass *built, const fm_instance *instance,
                            const fm_pass *pass)
{
    const uint32_t chosen = FM_FEATURE_INTERLOCK | FM_FEATURE_BUFFER_ADDRESS;
    const uint32_t optional = instance->method->features_optional & instance->device->caps.features;
    uint32_t features = (instance->method->features | optional) & ~chosen;
    if (!built->is_drawn) /* a fragment shader's alone */
        features &= ~(uint32_t)FM_FEATURE_STENCIL_EXPORT;
    if (has_interlock(instance, pass))
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
    if (!built->is_drawn)
        text_add(text, "layout(local_size_x = %d) in;\n", STAGE_GROUP_SIZE);
    define_all(text, instance, pass);
    shader_declare(text, built->uses + skipped, built->use_count - skipped, "pass");
    if (built->is_drawn)
        add_fragment_interface(text, instance, pass);
    return add_body(text, instance, pass, built->is_drawn, err);
}
