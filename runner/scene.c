#include "scene.h"

#include <stdlib.h>

static fm_status fill(fm_scene *scene, fm_error *err)
{
    switch (scene->settings.generator) {
    case FM_GENERATOR_LAYERS:
        return layers_generate(scene, err);
    case FM_GENERATOR_MESH:
        return mesh_load(scene, err);
    }
    return fm_fail(err, FM_INVALID, "a scene without a generator");
}

fm_status scene_create(fm_scene **scene, const fm_settings *settings, fm_error *err)
{
    *scene = NULL;
    fm_scene *made = calloc(1, sizeof *made);
    if (made == NULL)
        return fm_fail(err, FM_NO_MEMORY, "scene: %zu bytes", sizeof *made);
    made->settings = *settings;
    made->width_px = settings->width_px;
    made->height_px = settings->height_px;
    const fm_status status = fill(made, err);
    if (status != FM_OK) {
        scene_destroy(made);
        return status;
    }
    settings_scene_hash(made->hash, settings);
    *scene = made;
    return FM_OK;
}

void scene_destroy(fm_scene *scene)
{
    if (scene == NULL)
        return;
    free(scene->layers);
    free(scene->order);
    free(scene->vertices);
    free(scene->indices);
    free(scene->clip_from_object);
    free(scene);
}
