/* A mesh out of a file, as triangles near the origin.
 *
 * The room mesh reads files of meshes: it checks what they declare against what they hold, and says
 * what it left out. It knows nothing of scenes, cameras or colours. OBJ, PLY, OFF and STL have
 * readers of their own, in doubles; other formats go through libassimp. */
#ifndef FM_MESH_FILE_H
#define FM_MESH_FILE_H

#include "base/error.h"
#include "base/vec3.h"
#include "facts.h"
#include "space.h"

/* Starts as {0}. */
typedef struct fm_mesh {
    float (*positions)[3]; /* [vertex_count], in the space */
    vec3 *normals;         /* [vertex_count], of any length; the file's, or smooth, or of a facet */
    uint32_t *indices; /* [index_count], in the file's order of faces; every triangle has area */
    uint32_t vertex_count, index_count;
    fm_space space;
    fm_box box; /* of the vertices, in the space */
    fm_mesh_facts facts;
} fm_mesh;

/* FM_IO: no such file. FM_INVALID: it is damaged, cut off, badly indexed, has no triangle with an
 * area, or holds what cannot be read truly, with line or element and the reason. FM_NO_MEMORY.
 * mesh_free also after a failure. */
fm_status mesh_file_read(fm_mesh *mesh, const char *path, fm_error *err);
void mesh_free(fm_mesh *mesh);

#endif
