/* The readers, one a format. Each fills polygons that start as {0} from a whole file, and says what
 * of it is ignored. FM_INVALID: the file is wrong or cut off, with its line or element, or holds
 * what is not read; FM_NO_MEMORY. Indices of vertices are checked by whoever takes the polygons. */
#ifndef FM_MESH_READERS_H
#define FM_MESH_READERS_H

#include "polygons.h"
#include "scan.h"

fm_status obj_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err);
fm_status ply_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err);
fm_status off_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err);
/* Binary if the size is what the count of triangles asks for, or if it does not begin as text. */
fm_status stl_read(fm_polygons *polygons, const fm_file_bytes *file, fm_error *err);

/* All other formats, through libassimp, whose coordinates are floats. */
fm_status assimp_read(fm_polygons *polygons, const char *path, fm_error *err);
/* Whether libassimp has a reader for files of this ending (".3ds"). */
bool assimp_knows(const char *ending);

#endif
