#include "mesh.h"

#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "mesh/mesh_file.h"
#include "shade.h"

static fm_status shade_vertices(fm_scene *scene, const fm_mesh *mesh, fm_error *err)
{
    scene->vertices = calloc(mesh->vertex_count, sizeof *scene->vertices);
    if (scene->vertices == NULL)
        return fm_fail(err, FM_NO_MEMORY, "mesh of %" PRIu32 " vertices", mesh->vertex_count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++) {
        fm_vertex *vertex = &scene->vertices[i];
        memcpy(vertex->position, mesh->positions[i], sizeof vertex->position);
        vertex->colour = shade(mesh->normals[i], FM_STONE, scene->settings.alpha);
    }
    return FM_OK;
}

fm_status mesh_read(fm_scene *scene, fm_box *box, fm_error *err)
{
    fm_mesh mesh = { 0 };
    if (scene->settings.mesh[0] == '\0')
        return fm_fail(err, FM_INVALID, "mesh: no file is named");
    fm_status status = mesh_file_read(&mesh, scene->settings.mesh, err);
    if (status == FM_OK)
        status = shade_vertices(scene, &mesh, err);
    if (status == FM_OK) {
        scene->vertex_count = mesh.vertex_count;
        scene->index_count = mesh.index_count;
        scene->indices = mesh.indices;
        mesh.indices = NULL;
        scene->space = mesh.space;
        scene->facts = mesh.facts;
        *box = mesh.box;
    }
    mesh_free(&mesh);
    return status;
}
