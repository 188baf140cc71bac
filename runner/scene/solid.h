/* Closed bodies that hold a scene: what is drawn to learn between which depths its fragments lie.
 * No device. */
#ifndef FM_SOLID_H
#define FM_SOLID_H

#include "scene.h"

/* Triangles in any winding. Starts as {0}. */
typedef struct fm_solid {
    fm_vertex *vertices; /* colour 0; of meshes in object space, of layers in NDC; owned */
    uint32_t vertex_count;
    uint32_t *indices; /* owned */
    uint32_t index_count;
} fm_solid;

/* Meshes: the convex hull of all vertices, by qhull; its box where the vertices lie in one plane,
 * or qhull gives up for another reason than memory. Layers: two quads, each corner at the least and
 * at the greatest depth that a layer has there; between corners planes stay within. */
fm_status solid_hull(fm_solid *solid, const fm_scene *scene, fm_error *err);
/* The bounding box; of layers the two faces of one depth that it shows. */
fm_status solid_box(fm_solid *solid, const fm_scene *scene, fm_error *err);
/* Room for a solid; FM_NO_MEMORY. Whoever allocates frees. */
fm_status solid_allocate(fm_solid *solid, uint32_t vertices, uint32_t indices, fm_error *err);
void solid_free(fm_solid *solid);

/* A file that keeps a mesh's hull. solid_read: FM_IO, FM_INVALID: not there, damaged, or of a mesh
 * with another number of vertices. */
fm_status solid_read(fm_solid *solid, const char *path, const fm_scene *scene, fm_error *err);
fm_status solid_write(const fm_solid *solid, const char *path, const fm_scene *scene,
                      fm_error *err);

#endif
