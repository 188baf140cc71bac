/* Meshes from files, through libassimp. */
#ifndef FM_MESH_H
#define FM_MESH_H

#include "scene.h"

/* Reads the file scene->settings.mesh: fills vertices and indices. Vertices have a stone base
 * colour, shaded with settings.alpha (shade.h). box: of the vertices that triangles use, in the
 * file's units. FM_IO, FM_INVALID: a file that is missing, empty, cut off, not finite or badly
 * indexed; FM_INVALID, FM_NO_MEMORY: too large to hold. */
fm_status mesh_read(fm_scene *scene, fm_box *box, fm_error *err);

#endif
