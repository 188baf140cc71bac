#include "floor.h"

#include <stdlib.h>

#include "generators/generate.h"
#include "instance/instance.h"

enum { LAYERS = 32 };

struct floor_frames {
    fm_settings settings;
    fm_scene *scene;
    fm_stage *stage;
    fm_instance *instance;
};

static fm_status create(floor_frames *of, const calibrate_desc *desc, fm_error *err)
{
    settings_default(&of->settings);
    of->settings.n = LAYERS;
    of->settings.k = 1;
    fm_status status = settings_finish(&of->settings, err);
    if (status == FM_OK)
        status = scene_create(&of->scene, &of->settings, err);
    if (status == FM_OK)
        status = stage_create(&of->stage, desc->device, of->scene, NULL, FM_FEED_RASTER, err);
    if (status != FM_OK)
        return status;
    const fm_instance_desc instance = { .stage = of->stage,
                                        .method = desc->floor,
                                        .folders = desc->folders,
                                        .settings = &of->settings,
                                        .fragments = (uint64_t)floor_fragments(of) };
    return instance_create(&of->instance, &instance, err);
}

fm_status floor_create(floor_frames **made, const calibrate_desc *desc, fm_error *err)
{
    *made = calloc(1, sizeof **made);
    return *made != NULL ? create(*made, desc, err) : fm_fail(err, FM_NO_MEMORY, "the floor");
}

void floor_destroy(floor_frames *of)
{
    if (of == NULL)
        return;
    instance_destroy(of->instance);
    stage_destroy(of->stage);
    scene_destroy(of->scene);
    free(of);
}

/* Flat layers: every pixel of the rectangle has them all. */
double floor_fragments(const floor_frames *of)
{
    const fm_rect *rect = &of->scene->rect;
    return (double)(rect->x1 - rect->x0) * (rect->y1 - rect->y0) * of->scene->n;
}

fm_status floor_run(uint64_t *ns, floor_frames *of, fm_error *err)
{
    fm_frame_result result;
    const fm_status status = instance_frame(&result, of->instance, NULL, err);
    *ns = frame_passes_ns(&result);
    return status;
}
