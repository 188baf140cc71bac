#include "bundle_scenes.h"

#include <string.h>
#include <unistd.h>

#include "base/data.h"
#include "scene/scene_file.h"

/* Whether a path climbs above the folder that it is seen from. */
static bool leaves_folder(const char *path)
{
    int depth = 0;
    while (*path != '\0' && depth >= 0) {
        const size_t length = strcspn(path, "/");
        if (length == 2 && strncmp(path, "..", 2) == 0)
            depth--;
        else if (length > 0 && !(length == 1 && path[0] == '.'))
            depth++;
        path += length + (path[length] == '/');
    }
    return depth < 0;
}

static fm_status add_file(bundle_items *items, const char *scene, size_t folder_length,
                          const char *file, fm_error *err)
{
    char to[FM_PATH_MAX_BYTES];
    if (strncmp(file, scene, folder_length) != 0 || access(file, F_OK) != 0)
        return FM_OK;
    if (leaves_folder(file + folder_length))
        return fm_fail(err, FM_INVALID,
                       "%s: names %s, outside the folder of scenes: a bundle has no place for it",
                       scene, file);
    const fm_status status =
        path_join(to, data_bundle_folder(DATA_SCENES), file + folder_length, err);
    return status == FM_OK ? items_add(items, file, to, err) : status;
}

fm_status bundle_add_scene_files(bundle_items *items, fm_error *err)
{
    static const char ending[] = ".yml";
    fm_scene_names names;
    fm_status status = scene_names_list(&names, err);
    for (size_t i = 0; i < names.count && status == FM_OK; i++) {
        fm_settings settings;
        const char *path = names.paths[i];
        const size_t folder_length = strlen(path) - strlen(names.names[i]) - strlen(ending);
        if (scene_file_read(&settings, path, NULL) != FM_OK)
            continue; /* it is as damaged there as it is here */
        const char *file = settings_file(&settings);
        if (file != NULL && file[0] != '\0')
            status = add_file(items, path, folder_length, file, err);
    }
    scene_names_free(&names);
    return status;
}
