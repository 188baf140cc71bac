#include "scene.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "generators/procedural.h"

static fm_status fill_mesh(fm_scene *scene, fm_error *err)
{
    fm_box box;
    const fm_status status = mesh_read(scene, &box, err);
    return status == FM_OK ? scene_place(scene, &scene->settings, &box, err) : status;
}

static fm_status fill(fm_scene *scene, fm_error *err)
{
    switch (scene->settings.generator) {
    case FM_GENERATOR_LAYERS:
        return layers_generate(scene, err);
    case FM_GENERATOR_MESH:
        return fill_mesh(scene, err);
    case FM_GENERATOR_BUNNY_IN_CUBE:
        return bunny_in_cube_generate(scene, err);
    case FM_GENERATOR_PALACE:
    case FM_GENERATOR_HAIRBALL:
    case FM_GENERATOR_ENGINE:
    case FM_GENERATOR_TEMPLE:
    case FM_GENERATOR_HOTEL:
    case FM_GENERATOR_IVY:
        return procedural_generate(scene, err);
    case FM_GENERATOR_FRAMES:
    case FM_GENERATOR_STREAM:
    case FM_GENERATOR_ADVERSARIAL:
        break; /* no scene of fragments: frames.h */
    }
    return fm_fail(err, FM_INVALID, "generator %s: its scenes are for feed frames",
                   key_find("generator")->values[scene->settings.generator]);
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

fm_status scene_mesh(const fm_scene *scene, const fm_mesh_sink *sink, fm_error *err)
{
    if (scene->vertices == NULL)
        return procedural_stream(scene, sink, err);
    fm_status status = sink->vertices(sink->user, 0, scene->vertices, scene->vertex_count, err);
    if (status == FM_OK)
        status = sink->indices(sink->user, 0, scene->indices, scene->index_count, err);
    return status;
}

static fm_status hold_vertices(void *user, uint32_t first, const fm_vertex *vertices,
                               uint32_t count, fm_error *err)
{
    (void)err;
    memcpy(((fm_scene *)user)->vertices + first, vertices, count * sizeof *vertices);
    return FM_OK;
}

static fm_status hold_indices(void *user, uint32_t first, const uint32_t *indices, uint32_t count,
                              fm_error *err)
{
    (void)err;
    memcpy(((fm_scene *)user)->indices + first, indices, count * sizeof *indices);
    return FM_OK;
}

fm_status scene_hold(fm_scene *scene, fm_error *err)
{
    if (scene->vertices != NULL || scene_is_layers(scene))
        return FM_OK;
    fm_scene held = { .vertices = calloc(scene->vertex_count, sizeof *held.vertices),
                      .indices = calloc(scene->index_count, sizeof *held.indices) };
    const fm_mesh_sink sink = { &held, hold_vertices, hold_indices };
    fm_status status = FM_OK;
    if (held.vertices == NULL || held.indices == NULL)
        status = fm_fail(err, FM_NO_MEMORY, "mesh of %" PRIu32 " vertices and %" PRIu32 " indices",
                         scene->vertex_count, scene->index_count);
    if (status == FM_OK)
        status = procedural_stream(scene, &sink, err);
    if (status != FM_OK) {
        free(held.vertices);
        free(held.indices);
        return status;
    }
    scene->vertices = held.vertices;
    scene->indices = held.indices;
    return FM_OK;
}
