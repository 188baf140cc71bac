#include "scene.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

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
    if (scene->vertices == NULL && scene->make_mesh == NULL)
        return fm_fail(err, FM_INVALID, "a scene that holds no mesh and makes none");
    if (scene->vertices == NULL)
        return scene->make_mesh(scene, sink, err);
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
        status = scene_mesh(scene, &sink, err);
    if (status != FM_OK) {
        free(held.vertices);
        free(held.indices);
        return status;
    }
    scene->vertices = held.vertices;
    scene->indices = held.indices;
    return FM_OK;
}
