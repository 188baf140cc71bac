/* The door of generators/: makes the scene, or the sequence of frames, that settings describe.
 *
 * Each generator has a file of its own here and is reached through this one. Generators fill
 * scenes; they know no method, device or truth. What a generator makes follows from the settings
 * and their seed alone, the same on every machine; whoever changes what it makes raises its version
 * (generator_version, model/settings.h). */
#ifndef FM_GENERATE_H
#define FM_GENERATE_H

#include "scene/frames.h"
#include "scene/scene.h"

/* Builds the scene that settings describe; settings must have passed settings_finish.
 * FM_IO, FM_INVALID: meshes that are missing, empty, truncated, not finite or badly indexed. Of an
 * OBJ file, which states no counts, only what is cut within a line or refers to lost vertices
 * shows. FM_INVALID, FM_NO_MEMORY: scenes too large to hold. */
fm_status scene_create(fm_scene **scene, const fm_settings *settings, fm_error *err);

/* Makes the sequence of frames that settings of generator frames, adversarial or stream describe.
 * The caller destroys it with sequence_destroy. FM_INVALID: a viewport over FRAMES_SIDE_MAX, or not
 * the recorded one; a file that is no stream or is cut off. FM_IO: it cannot be read. FM_NO_MEMORY.
 */
fm_status sequence_create(fm_sequence **sequence, const fm_settings *settings, fm_error *err);

#endif
