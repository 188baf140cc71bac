/* Polygons become a mesh. */
#ifndef FM_MESH_BUILD_H
#define FM_MESH_BUILD_H

#include "mesh_file.h"
#include "polygons.h"

/* Checks the polygons, cuts them, moves them into their space, and shares equal vertices. The
 * polygons are used up, and still to be freed. path: for messages. */
fm_status mesh_build(fm_mesh *mesh, fm_polygons *polygons, const char *path, fm_error *err);

#endif
