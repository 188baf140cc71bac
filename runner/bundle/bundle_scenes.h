/* Which meshes and streams go into a bundle: those that its scenes name. */
#ifndef FM_BUNDLE_SCENES_H
#define FM_BUNDLE_SCENES_H

#include "items.h"

/* Adds the file that each scene names beside itself, whatever its ending. A file that is not here
 * is left out, as is one with an absolute name: the other machine is asked for it at the same
 * place. FM_INVALID: it lies outside the folder of scenes, which is all that a bundle holds. */
fm_status bundle_add_scene_files(bundle_items *items, fm_error *err);

#endif
