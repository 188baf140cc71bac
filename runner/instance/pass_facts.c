/* What is true of a pass on this device, with this scene and these options: everything that others
 * ask before they build, draw or declare it. */
#include <string.h>

#include "instance_internal.h"
#include "model/formula.h"

bool instance_is_narrow(const fm_instance *instance)
{
    return instance->device->caps.subgroup_size < 32;
}

bool pass_is_left_out(const fm_instance *instance, const fm_pass *pass)
{
    return pass->narrow_only && !instance_is_narrow(instance);
}

uint32_t pass_number(const fm_instance *instance, const fm_pass *pass)
{
    uint32_t i = 0;
    while (i < FM_MAX_PASSES && pass != &instance->method->passes[i])
        i++;
    return i;
}

/* An eighth is for what a shader does besides. */
uint32_t pass_run_iterations(const fm_instance *instance)
{
    return instance->device->caps.loop_limit / 8 * 7;
}

/* What a store costs at most: twice k, since a lock runs its loops again for nobody, and its own.
 */
uint32_t pass_feed_step(const fm_instance *instance, const fm_pass *pass)
{
    enum { STORE_ITERATIONS = 48 };
    const uint32_t each = STORE_ITERATIONS + 2 * instance->workload.k;
    const uint32_t step = pass_run_iterations(instance) / each;
    const bool loops = pass_is_scene(pass) && instance->desc.stage->feed == FM_FEED_COMPUTE_PIXEL &&
                       instance->device->caps.loop_limit > 0;
    return loops && instance->workload.n > step ? step : 0;
}

bool pass_resumes(const fm_instance *instance, const fm_pass *pass)
{
    const uint64_t n = instance->workload.n, k = instance->workload.k;
    const uint32_t limit = instance->device->caps.loop_limit;
    const bool is_deep_k = k > limit / 64;
    if (limit == 0)
        return false;
    switch (pass->resumes) {
    case FM_RESUMES_BY_N:
        return n > limit / 32;
    case FM_RESUMES_BY_K:
        return is_deep_k;
    case FM_RESUMES_BY_N_K:
        return is_deep_k || n * (k + 2) > limit / 4 * 3;
    case FM_RESUMES_NEVER:
    case FM_RESUMES_COUNT:
        break;
    }
    return pass_feed_step(instance, pass) > 0;
}

uint32_t pass_lanes(const fm_instance *instance, const fm_pass *pass)
{
    const uint32_t lanes =
        instance_is_narrow(instance) && pass->lanes_narrow > 0 ? pass->lanes_narrow : pass->lanes;
    return lanes > 0 ? lanes : 1;
}

bool pass_reads_triangles(const fm_instance *instance, const fm_pass *pass)
{
    return instance->desc.stage->feed == FM_FEED_TRIANGLES &&
           (pass->kind == FM_PASS_TRIANGLES || pass->kind == FM_PASS_TILES ||
            pass->kind == FM_PASS_TOTAL || pass->kind == FM_PASS_INDIRECT);
}

bool pass_is_drawn(const fm_instance *instance, const fm_pass *pass)
{
    if (pass_is_scene(pass))
        return instance->desc.stage->feed == FM_FEED_RASTER;
    return pass->kind == FM_PASS_PIXELS &&
           (pass_has_fixed_function(pass) ||
            instance->desc.settings->full_screen == FM_FULL_SCREEN_FRAGMENT);
}

/* Whether an option has a value; without a name, always. */
static bool option_is(const fm_instance *instance, const char *option, const char *value)
{
    const char *chosen =
        option != NULL ? instance->workload.option(&instance->workload, option) : value;
    return chosen != NULL && strcmp(chosen, value) == 0;
}

static bool is_flat(const fm_instance *instance, const fm_pass *pass)
{
    return pass->flat_tessellation && option_is(instance, pass->flat_option, "flat");
}

bool pass_has_lock_in_word(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && instance->is_spin_locked && pass->lock_word != NULL &&
           option_is(instance, pass->lock_word_option, "lock");
}

bool pass_has_own_locks(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && instance->is_spin_locked && !pass_has_lock_in_word(instance, pass);
}

fm_geometry pass_geometry(const fm_instance *instance, const fm_pass *pass)
{
    switch (pass->cover) {
    case FM_COVER_HULL:
        return FM_GEOMETRY_HULL;
    case FM_COVER_BOX:
        return FM_GEOMETRY_BOX;
    case FM_COVER_NONE:
    case FM_COVER_COUNT:
        break;
    }
    return is_flat(instance, pass) ? FM_GEOMETRY_FLAT : FM_GEOMETRY_SCENE;
}

bool pass_has_interlock(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && !instance->is_spin_locked;
}

/* The first pass that emits starts the picture. */
bool pass_has_memory_model(const fm_instance *instance, const fm_pass *pass)
{
    const fm_device_caps *caps = &instance->device->caps;
    return pass->exclusive && instance->is_spin_locked && caps->needs_lock_barriers &&
           caps->has_memory_model;
}

bool pass_emits_first(const fm_instance *instance, const fm_pass *pass)
{
    for (const fm_pass *before = instance->method->passes; before < pass; before++)
        if (before->emits && !pass_is_left_out(instance, before))
            return false;
    return true;
}

/* A software rasteriser draws the fragments of a pixel on one thread, one after the other: nobody
 * waits for a lock there. Dispatches have several. */
bool pass_lock_waits(const fm_instance *instance, const fm_pass *pass)
{
    return pass->exclusive && instance->is_spin_locked && instance->device->caps.loop_limit > 0 &&
           !(instance->device->caps.is_software && pass_is_drawn(instance, pass));
}

uint64_t pass_units(const fm_instance *instance, const fm_pass *pass)
{
    const fm_workload *workload = &instance->workload;
    const int total = total_index(instance->method, pass->count_total);
    switch (pass->kind) {
    case FM_PASS_SCENE:
        return instance->desc.stage->invocations;
    case FM_PASS_PIXELS:
        return (uint64_t)workload->width_px * workload->height_px;
    case FM_PASS_TILES:
        return workload_tiles(workload);
    case FM_PASS_TRIANGLES:
        return workload->triangles;
    case FM_PASS_TOTAL:
        return total >= 0 ? instance->totals[total] : 0;
    case FM_PASS_INDIRECT:
    case FM_PASS_CLEAR:
    case FM_PASS_HOST:
    case FM_PASS_KIND_COUNT:
        break;
    }
    return 0;
}

uint64_t pass_invocations(const fm_instance *instance, const fm_pass *pass)
{
    return pass_units(instance, pass) * pass_lanes(instance, pass);
}
