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

static bool is_flat(const fm_instance *instance, const fm_pass *pass)
{
    if (!pass->flat_tessellation || pass->flat_option == NULL)
        return pass->flat_tessellation;
    const char *value = instance->workload.option(&instance->workload, pass->flat_option);
    return value != NULL && strcmp(value, "flat") == 0;
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
bool pass_emits_first(const fm_instance *instance, const fm_pass *pass)
{
    for (const fm_pass *before = instance->method->passes; before < pass; before++)
        if (before->emits && !pass_is_left_out(instance, before))
            return false;
    return true;
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
