/* Finding scene files, and the YAML values of keys; shared by scene files and specs. */
#ifndef FM_SCENE_FILE_H
#define FM_SCENE_FILE_H

#include "base/error.h"
#include "base/yaml_tree.h"
#include "model/settings.h"

/* The file of a scene: the name itself if it ends with ".yml", else NAME.yml of the first scene
 * folder that has it. FM_INVALID: no such scene, with the nearest name. */
fm_status scene_file_find(char path[FM_PATH_MAX_BYTES], const char *name, fm_error *err);

/* One value of a key as text: a scalar, or a sequence of three numbers for a vector; file names are
 * taken as seen from `file`. FM_INVALID: neither, with file and line. */
fm_status scene_file_value(char text[FM_PATH_MAX_BYTES], const fm_key *key, const fm_yaml *value,
                           const char *file, fm_error *err);

#endif
