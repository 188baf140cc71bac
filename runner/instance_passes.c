/* Passes as data become GLSL and pipelines. */
#include "instance_internal.h"

#include <ctype.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Spins until a lock is given up and the fragment counted as lost: bounded, since a hung GPU helps
 * nobody. In Mesa's software a try costs an iteration of the spin and one of each loop in store(),
 * taken or not, out of 65 535 for all: where they end, a store ends half way and nobody knows.
 * Three loops in store() fit. */
enum { SPIN_MAX = 1 << 20, SPIN_MAX_SOFTWARE = 16000 };

static bool is_scene(const fm_pass *pass)
{
    return pass->kind == FM_PASS_SCENE;
}

static bool has_fixed_function(const fm_pass *pass)
{
    return pass->targets[0].resource != NULL || pass->state.depth_stencil != NULL;
}

static bool is_drawn(const fm_instance *instance, const fm_pass *pass)
{
    if (is_scene(pass))
        return instance->desc.stage->feed == FM_FEED_RASTER;
    return pass->kind == FM_PASS_PIXELS &&
           (has_fixed_function(pass) ||
            instance->desc.settings->full_screen == FM_FULL_SCREEN_FRAGMENT);
}

static bool has_interlock(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && !instance->is_spin_locked;
}

const char *option_value(const fm_instance *instance, const fm_option *option)
{
    for (size_t i = 0; i < instance->desc.choice_count; i++)
        if (strcmp(instance->desc.choices[i].name, option->name) == 0)
            return instance->desc.choices[i].value;
    return option->values[0];
}

bool pass_is_flat(const fm_instance *instance, const fm_pass *pass)
{
    if (!pass->flat_tessellation || pass->flat_option == NULL)
        return pass->flat_tessellation;
    const char *value = instance->workload.option(&instance->workload, pass->flat_option);
    return value != NULL && strcmp(value, "flat") == 0;
}

/* ---- what a pass uses ---- */

static void add_use(built_pass *built, fm_slot *slot, uint32_t access, bool is_coherent,
                    resource_ref ref)
{
    for (size_t i = 0; i < built->use_count; i++) {
        if (built->uses[i].slot == slot) {
            built->uses[i].access |= access;
            return;
        }
    }
    if (built->use_count == INSTANCE_USES_MAX) {
        built->is_overfull = true;
        return;
    }
    built->refs[built->use_count] = ref;
    built->uses[built->use_count++] =
        (fm_use){ .slot = slot, .access = access, .is_coherent = is_coherent };
}

static void add_resource(built_pass *built, fm_instance *instance, const char *name,
                         uint32_t access, bool is_coherent)
{
    resource_ref ref;
    ref.index = resource_index(instance->method, name, &ref.is_previous);
    add_use(built, &instance->resources[ref.index][ref.is_previous ? 1 : 0], access, is_coherent,
            ref);
}

static void add_stage(built_pass *built, fm_instance *instance, int slot, uint32_t access)
{
    add_use(built, &instance->desc.stage->slots[slot], access, false,
            (resource_ref){ .index = -1 });
}

static void add_emit(built_pass *built, fm_instance *instance)
{
    if (instance->desc.is_capture) {
        add_stage(built, instance, STAGE_CAPTURE, FM_ACCESS_WRITE);
        add_stage(built, instance, STAGE_CAPTURE_COUNTS, FM_ACCESS_READ | FM_ACCESS_WRITE);
        return;
    }
    add_stage(built, instance, STAGE_OUTPUT, FM_ACCESS_READ | FM_ACCESS_WRITE);
    if (instance->emits_back)
        add_stage(built, instance, STAGE_OUTPUT_BACK, FM_ACCESS_READ | FM_ACCESS_WRITE);
}

static void collect_uses(built_pass *built, fm_instance *instance, const fm_pass *pass)
{
    const bool is_shared = is_scene(pass); /* many invocations a pixel */
    if (is_scene(pass)) {
        built->use_count = stage_uses(built->uses, instance->desc.stage);
        built->stage_use_count = built->use_count;
        for (size_t i = 0; i < built->use_count; i++)
            built->refs[i].index = -1;
    }
    for (int i = 0; i < FM_MAX_ACCESSES && pass->reads[i] != NULL; i++)
        add_resource(built, instance, pass->reads[i], FM_ACCESS_READ, is_shared);
    for (int i = 0; i < FM_MAX_ACCESSES && pass->writes[i] != NULL; i++)
        add_resource(built, instance, pass->writes[i], FM_ACCESS_READ | FM_ACCESS_WRITE, is_shared);
    if (pass->exclusive && instance->is_spin_locked)
        add_use(built, &instance->locks, FM_ACCESS_READ | FM_ACCESS_WRITE, true,
                (resource_ref){ .index = -1 });
    add_stage(built, instance, STAGE_COUNTERS, FM_ACCESS_READ | FM_ACCESS_WRITE);
    if (pass->emits)
        add_emit(built, instance);
    for (size_t i = 0; i < built->use_count; i++)
        built->uses[i].binding = SHADER_BINDING_FIRST + (uint32_t)i;
}

static bool any_address(const built_pass *built)
{
    for (size_t i = 0; i < built->use_count; i++)
        if (built->uses[i].slot->by_address)
            return true;
    return false;
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
        if (before->emits)
            return false;
    return true;
}

static void define_all(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    const fm_device_caps *caps = &instance->device->caps;
    stage_define(text, instance->desc.stage, pass_is_flat(instance, pass));
    shader_define(text, "K", instance->workload.k > 0 ? instance->workload.k : 1);
    shader_define(text, "N", instance->workload.n > 0 ? instance->workload.n : 1);
    shader_define(text, "FM_SPIN_MAX", caps->loop_limit > 0 ? SPIN_MAX_SOFTWARE : SPIN_MAX);
    shader_define(text, "FM_EXCLUSIVE", pass->exclusive && instance->is_spin_locked);
    shader_define(text, "FM_INTERLOCK", has_interlock(instance, pass));
    shader_define(text, "FM_TARGETS", has_fixed_function(pass));
    shader_define(text, "FM_EMIT_FIRST", emits_first(instance, pass));
    if (instance->emits_back)
        shader_define(text, "FM_EMITS_BACK", 1);
    if (instance->desc.is_capture) {
        shader_define(text, "FM_CAPTURE", 1);
        shader_define(text, "FM_CAPTURE_SLOTS", instance->desc.capture_slots);
    }
    if (instance->desc.wants_primitive && is_scene(pass)) {
        fm_draw draw = { 0 };
        stage_draw(&draw, instance->desc.stage, pass_is_flat(instance, pass));
        shader_define(text, "FM_PRIMITIVE", 1);
        shader_define(text, "FM_INSTANCE_TRIANGLES", draw.vertex_count / 3);
        text_add(text, "uint fm_primitive;\n");
    }
    for (int i = 0; i < FM_MAX_OPTIONS && instance->method->options[i].name != NULL; i++)
        define_option(text, &instance->method->options[i],
                      option_value(instance, &instance->method->options[i]));
}

/* ---- sources ---- */

static void add_fragment_interface(fm_text *text, const fm_instance *instance, const fm_pass *pass)
{
    if (has_interlock(instance, pass))
        text_add(text, "layout(pixel_interlock_unordered) in;\n");
    if (pass->state.early_tests)
        text_add(text, "layout(early_fragment_tests) in;\n");
    if (is_scene(pass)) {
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
        text_add(text, "void main()\n{\n    uvec2 pixel = uvec2(gl_FragCoord.xy);\n");
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
    text_add(text, "void main()\n{\n"
                   "    uint id = gl_GlobalInvocationID.y * (gl_NumWorkGroups.x * "
                   "gl_WorkGroupSize.x)\n        + gl_GlobalInvocationID.x;\n");
    if (pass->kind == FM_PASS_TILES || pass->kind == FM_PASS_TRIANGLES)
        text_add(text, "    if (id >= %uu)\n        return;\n",
                 (uint32_t)pass_invocations(instance, pass));
    if (pass->kind == FM_PASS_TOTAL) /* the total travels in the parameter block */
        text_add(text, "    if (id >= fm_band_first)\n        return;\n");
    text_add(text, "    %s(id);\n}\n", name);
}

static fm_status add_body(fm_text *text, const fm_instance *instance, const fm_pass *pass,
                          bool drawn, fm_error *err)
{
    const fm_shader_folders *folders = &instance->desc.folders;
    fm_status status = shader_add_file(text, folders, "common/prelude.glsl", err);
    if (status == FM_OK && is_scene(pass) && scene_is_layers(instance->desc.stage->scene))
        status = shader_add_file(text, folders, "common/layers.glsl", err);
    if (status == FM_OK && pass->emits)
        status = shader_add_file(text, folders, "common/emit.glsl", err);
    if (status == FM_OK)
        status = shader_add_file(text, folders, pass->shader, err);
    if (status != FM_OK)
        return status;
    if (!is_scene(pass)) {
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

/* Interlock is the lock's, not the method's; buffers choose how they are reached. */
static uint32_t features_of(const built_pass *built, const fm_instance *instance,
                            const fm_pass *pass)
{
    const uint32_t chosen = FM_FEATURE_INTERLOCK | FM_FEATURE_BUFFER_ADDRESS;
    uint32_t features = instance->method->features & ~chosen;
    if (!built->is_drawn) /* a fragment shader's alone */
        features &= ~(uint32_t)FM_FEATURE_STENCIL_EXPORT;
    if (has_interlock(instance, pass))
        features |= FM_FEATURE_INTERLOCK;
    if (any_address(built))
        features |= FM_FEATURE_BUFFER_ADDRESS;
    return features;
}

/* The fragment or compute shader of a pass. */
static fm_status pass_source(fm_text *text, const built_pass *built, const fm_instance *instance,
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

/* ---- pipelines ---- */

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
    bool is_previous;
    const fm_resource *resource =
        &instance->method->resources[resource_index(instance->method, name, &is_previous)];
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
    if (is_scene(pass))
        return stage_vertex_shader(text, built->uses, built->stage_use_count, instance->desc.stage,
                                   folders, pass_is_flat(instance, pass), err);
    shader_begin(text, &instance->device->caps, 0);
    return shader_add_file(text, folders, "common/full_screen_vertex.glsl", err);
}

static uint32_t pipeline_count(const fm_instance *instance, const fm_pass *pass)
{
    uint32_t count = 1;
    if (pass->state.stencil_reference_step == 0 && pass->state.sample_mask_step == 0)
        return 1;
    for (int i = 0; i < FM_MAX_LOOPS && instance->method->loops[i].first != NULL; i++) {
        const fm_loop *loop = &instance->method->loops[i];
        const int at = (int)(pass - instance->method->passes);
        if (pass_index(instance->method, loop->first) <= at &&
            at <= pass_index(instance->method, loop->last))
            count = loop->count + loop->count_per_k * instance->workload.k +
                    loop->count_per_n * instance->workload.n;
    }
    return count > 0 ? count : 1;
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
        if (is_scene(pass))
            stage_vertex_layout(&desc, instance->desc.stage);
    }
    built->pipeline_count = pipeline_count(instance, pass);
    built->pipelines = calloc(built->pipeline_count, sizeof(fm_pipeline *));
    if (built->pipelines == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "%s: pipelines", name);
    for (uint32_t i = 0; i < built->pipeline_count && status == FM_OK; i++) {
        desc.iteration = i;
        status = instance->device->ops->pipeline_create(&built->pipelines[i], instance->device,
                                                        &desc, err);
    }
out:
    text_free(&source);
    text_free(&vertex);
    return status;
}

static fm_status build_pass(built_pass *built, fm_instance *instance, const fm_pass *pass,
                            fm_error *err)
{
    *built = (built_pass){ .is_drawn = is_drawn(instance, pass) };
    if (pass->kind == FM_PASS_HOST || pass->kind == FM_PASS_CLEAR)
        return FM_OK;
    collect_uses(built, instance, pass);
    if (built->is_overfull)
        return fm_fail(err, FM_UNSUPPORTED,
                       "%s: pass '%s': more than %d resources, the feed's own included",
                       instance->method->id, pass->name, INSTANCE_USES_MAX);
    return create_pipelines(built, instance, pass, err);
}

/* The runner's own last pass for methods that emit from both ends. */
static fm_status build_combine(fm_instance *instance, fm_error *err)
{
    static const fm_pass pass = { .name = "combine",
                                  .kind = FM_PASS_PIXELS,
                                  .shader = "common/combine.glsl" };
    built_pass *built = &instance->combine;
    *built = (built_pass){ 0 };
    collect_uses(built, instance, &pass);
    add_stage(built, instance, STAGE_OUTPUT, FM_ACCESS_READ | FM_ACCESS_WRITE);
    add_stage(built, instance, STAGE_OUTPUT_BACK, FM_ACCESS_READ);
    for (size_t i = 0; i < built->use_count; i++)
        built->uses[i].binding = SHADER_BINDING_FIRST + (uint32_t)i;
    return create_pipelines(built, instance, &pass, err);
}

fm_status passes_create(fm_instance *instance, fm_error *err)
{
    fm_status status = FM_OK;
    for (size_t i = 0; i < instance->pass_count && status == FM_OK; i++)
        status = build_pass(&instance->passes[i], instance, &instance->method->passes[i], err);
    if (status == FM_OK && instance->emits_back && !instance->desc.is_capture)
        status = build_combine(instance, err);
    return status;
}

static void destroy_pass(fm_instance *instance, built_pass *built)
{
    for (uint32_t i = 0; built->pipelines != NULL && i < built->pipeline_count; i++)
        instance->device->ops->pipeline_destroy(instance->device, built->pipelines[i]);
    free(built->pipelines);
    *built = (built_pass){ 0 };
}

void passes_destroy(fm_instance *instance)
{
    for (size_t i = 0; i < instance->pass_count; i++)
        destroy_pass(instance, &instance->passes[i]);
    destroy_pass(instance, &instance->combine);
}
