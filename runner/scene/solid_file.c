#include <stdlib.h>
#include <string.h>

#include "base/text.h"
#include "solid.h"

typedef struct solid_header {
    char magic[8]; /* "fmhull1" */
    uint32_t mesh_vertices, vertices, indices, unused;
} solid_header;
_Static_assert(sizeof(solid_header) == 24, "no padding in the file");

static const char magic[8] = "fmhull1";
#define FILE_MAX_BYTES ((size_t)1 << 30)

static size_t file_bytes(const solid_header *header)
{
    return sizeof *header + (size_t)header->vertices * sizeof(fm_vertex) +
           (size_t)header->indices * sizeof(uint32_t);
}

static bool is_sound(const char *bytes, size_t count, const solid_header *header,
                     const fm_scene *scene)
{
    if (memcmp(header->magic, magic, sizeof magic) != 0 ||
        header->mesh_vertices != scene->vertex_count || count != file_bytes(header) ||
        header->indices % 3 != 0)
        return false;
    const char *indices = bytes + sizeof *header + (size_t)header->vertices * sizeof(fm_vertex);
    for (uint32_t i = 0; i < header->indices; i++) {
        uint32_t index;
        memcpy(&index, indices + i * sizeof index, sizeof index);
        if (index >= header->vertices)
            return false;
    }
    return true;
}

fm_status solid_read(fm_solid *solid, const char *path, const fm_scene *scene, fm_error *err)
{
    char *bytes = NULL;
    size_t count = 0;
    solid_header header = { .indices = 0 };
    *solid = (fm_solid){ 0 };
    fm_status status = text_read_file(&bytes, &count, path, FILE_MAX_BYTES, err);
    if (status != FM_OK)
        return status;
    if (count >= sizeof header)
        memcpy(&header, bytes, sizeof header);
    if (!is_sound(bytes, count, &header, scene))
        status = fm_fail(err, FM_INVALID, "%s: not the hull of a mesh of %u vertices", path,
                         scene->vertex_count);
    if (status == FM_OK)
        status = solid_allocate(solid, header.vertices, header.indices, err);
    if (status == FM_OK) {
        memcpy(solid->vertices, bytes + sizeof header, header.vertices * sizeof(fm_vertex));
        memcpy(solid->indices, bytes + sizeof header + header.vertices * sizeof(fm_vertex),
               header.indices * sizeof(uint32_t));
    }
    free(bytes);
    return status;
}

fm_status solid_write(const fm_solid *solid, const char *path, const fm_scene *scene, fm_error *err)
{
    solid_header header = { .mesh_vertices = scene->vertex_count,
                            .vertices = solid->vertex_count,
                            .indices = solid->index_count };
    memcpy(header.magic, magic, sizeof magic);
    const size_t count = file_bytes(&header);
    char *bytes = malloc(count);
    if (bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes", path, count);
    memcpy(bytes, &header, sizeof header);
    memcpy(bytes + sizeof header, solid->vertices, solid->vertex_count * sizeof(fm_vertex));
    memcpy(bytes + sizeof header + solid->vertex_count * sizeof(fm_vertex), solid->indices,
           solid->index_count * sizeof(uint32_t));
    const fm_status status = text_write_file(path, bytes, count, err);
    free(bytes);
    return status;
}
