/* Where instances of a mesh stand before the camera. */
#ifndef FM_PLACEMENT_H
#define FM_PLACEMENT_H

#include "scene.h"

/* Sees instances of a mesh with this box, in the scene's space: fills clip_from_object, instances,
 * triangles. The box that camera and planes are fitted to holds all instances; instance i is moved
 * by i * instance_offset * the size of the mesh's own box. camera: whose eye ... zoom and instances
 * are read; usually scene->settings. FM_INVALID: no camera sees it, or it is beyond a float's
 * range. FM_NO_MEMORY. */
fm_status scene_place(fm_scene *scene, const fm_settings *camera, const fm_box *box, fm_error *err);

#endif
