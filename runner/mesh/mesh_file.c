#include "mesh_file.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/file.h"
#include "mesh_build.h"
#include "readers.h"

static const size_t file_max_bytes = (size_t)1 << 36;

typedef fm_status file_reader(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err);

static const struct {
    const char *ending, *name;
    file_reader *read;
} formats[] = {
    { ".obj", "OBJ", obj_read },
    { ".ply", "PLY", ply_read },
    { ".off", "OFF", off_read },
    { ".stl", "STL", stl_read },
};
enum { FORMAT_COUNT = sizeof formats / sizeof formats[0] };

/* Before libassimp opens it. */
static fm_status check_file(const char *path, fm_error *err)
{
    int fd = -1;
    const fm_status status = file_open(&fd, NULL, path, err);
    if (status == FM_OK)
        close(fd);
    return status;
}

static fm_status read_own(fm_polygons *polygons, file_reader *read, const char *path, fm_error *err)
{
    char *bytes = NULL;
    fm_file_bytes file = { .path = path };
    fm_status status = text_read_file(&bytes, &file.count, path, file_max_bytes, err);
    file.bytes = bytes != NULL ? bytes : "";
    if (status == FM_OK)
        status = read(polygons, &file, err);
    free(bytes);
    return status;
}

static fm_status read_polygons(fm_polygons *polygons, const char *path, fm_error *err)
{
    const char *name = strrchr(path, '/') != NULL ? strrchr(path, '/') + 1 : path;
    const char *ending = strrchr(name, '.') != NULL ? strrchr(name, '.') : "";
    fm_mesh_facts *facts = &polygons->facts;
    for (size_t i = 0; i < FORMAT_COUNT; i++)
        if (strcasecmp(ending, formats[i].ending) == 0) {
            snprintf(facts->format, sizeof facts->format, "%s", formats[i].name);
            return read_own(polygons, formats[i].read, path, err);
        }
    if (!assimp_knows(ending))
        return fm_fail(err, FM_INVALID,
                       "%s: no reader for files that end with '%s': the ending says the format, as "
                       "in .obj, .ply, .off, .stl, .3ds, .glb",
                       path, ending);
    snprintf(facts->format, sizeof facts->format, "%s", ending + 1);
    return assimp_read(polygons, path, err);
}

fm_status mesh_file_read(fm_mesh *mesh, const char *path, fm_error *err)
{
    fm_polygons polygons = { 0 };
    fm_status status = check_file(path, err);
    if (status == FM_OK)
        status = read_polygons(&polygons, path, err);
    if (status == FM_OK)
        status = mesh_build(mesh, &polygons, path, err);
    polygons_free(&polygons);
    return status;
}

void mesh_free(fm_mesh *mesh)
{
    free(mesh->positions);
    free(mesh->normals);
    free(mesh->indices);
    *mesh = (fm_mesh){ 0 };
}
