/* The resources that a pass uses, in the order of their bindings. */
#include "instance_internal.h"
#include "model/formats.h"

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
    const resource_ref ref = resource_find(instance->method, name);
    add_use(built, &instance->resources[ref.index][ref.is_previous ? 1 : 0], access, is_coherent,
            ref);
}

void pass_use_stage(built_pass *built, fm_instance *instance, int slot, uint32_t access)
{
    add_use(built, &instance->desc.stage->slots[slot], access, false,
            (resource_ref){ .index = -1 });
}

static void add_emit(built_pass *built, fm_instance *instance)
{
    if (instance->desc.is_capture) {
        pass_use_stage(built, instance, STAGE_CAPTURE, FM_ACCESS_WRITE);
        pass_use_stage(built, instance, STAGE_CAPTURE_COUNTS, FM_ACCESS_READ | FM_ACCESS_WRITE);
        return;
    }
    pass_use_stage(built, instance, STAGE_OUTPUT, FM_ACCESS_READ | FM_ACCESS_WRITE);
    if (instance->emits_back)
        pass_use_stage(built, instance, STAGE_OUTPUT_BACK, FM_ACCESS_READ | FM_ACCESS_WRITE);
}

/* As pass.h says of fm_resumes: what such a pass reads it may sort. */
static uint32_t read_access(const fm_instance *instance, const fm_pass *pass, const char *name)
{
    const fm_resource *resource =
        &instance->method->resources[resource_find(instance->method, name).index];
    const bool can_store =
        resource->kind == FM_RESOURCE_BUFFER ||
        (!format_has_depth(resource->format) && resource_samples(instance, resource) == 1);
    const bool may_write =
        pass->resumes != FM_RESUMES_NEVER && pass_resumes(instance, pass) && can_store;
    return may_write ? FM_ACCESS_READ | FM_ACCESS_WRITE : FM_ACCESS_READ;
}

void pass_collect_uses(built_pass *built, fm_instance *instance, const fm_pass *pass)
{
    const bool is_shared = pass_is_scene(pass); /* many invocations a pixel */
    if (pass_is_scene(pass) || pass_reads_triangles(instance, pass)) {
        built->use_count =
            stage_uses(built->uses, instance->desc.stage, pass_geometry(instance, pass));
        built->stage_use_count = built->use_count;
        for (size_t i = 0; i < built->use_count; i++)
            built->refs[i].index = -1;
    }
    for (int i = 0; i < FM_MAX_ACCESSES && pass->reads[i] != NULL; i++)
        add_resource(built, instance, pass->reads[i], read_access(instance, pass, pass->reads[i]),
                     is_shared);
    for (int i = 0; i < FM_MAX_ACCESSES && pass->writes[i] != NULL; i++)
        add_resource(built, instance, pass->writes[i], FM_ACCESS_READ | FM_ACCESS_WRITE, is_shared);
    if (pass_has_own_locks(instance, pass))
        add_use(built, &instance->locks, FM_ACCESS_READ | FM_ACCESS_WRITE, true,
                (resource_ref){ .index = -1 });
    pass_use_stage(built, instance, STAGE_COUNTERS, FM_ACCESS_READ | FM_ACCESS_WRITE);
    if (pass->emits)
        add_emit(built, instance);
    for (size_t i = 0; i < built->use_count; i++)
        built->uses[i].binding = SHADER_BINDING_FIRST + (uint32_t)i;
}
