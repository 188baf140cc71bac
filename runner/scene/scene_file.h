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

/* Names and files of all scenes in the scene folders; lists end with NULL inside. */
typedef struct fm_scene_names {
    char (*names)[128];
    char (*paths)[FM_PATH_MAX_BYTES];
    size_t count;
} fm_scene_names;
fm_status scene_names_list(fm_scene_names *names, fm_error *err);
void scene_names_free(fm_scene_names *names);

/* Fills settings from a scene file: key: value lines, or nothing but a name. */
fm_status scene_file_read(fm_settings *settings, const char *path, fm_error *err);

#endif
