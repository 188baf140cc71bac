/* Meshes from files, as scenes draw them. */
#ifndef FM_MESH_H
#define FM_MESH_H

#include "scene.h"

/* Reads the file scene->settings.mesh: fills vertices, indices, space and facts. Vertices have a
 * stone base colour, shaded with settings.alpha (shade.h). box: of the vertices, in the space.
 * Returns what mesh_file_read does, and FM_INVALID without a file's name. */
fm_status mesh_read(fm_scene *scene, fm_box *box, fm_error *err);

#endif
