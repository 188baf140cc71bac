#include "shader_files.h"

#include <stdio.h>
#include <string.h>
#include <unistd.h>

static bool is_known(const char *folder)
{
    return folder != NULL && folder[0] != '\0';
}

/* A file of another method, seen from the folder of one. */
static fm_status find_beside(char path[FM_PATH_MAX_BYTES], const char *folder, const char *file,
                             fm_error *err)
{
    char other[FM_PATH_MAX_BYTES];
    snprintf(other, sizeof other, "../%s", file);
    return path_join(path, folder, other, err);
}

fm_status shader_file_find(char path[FM_PATH_MAX_BYTES], const fm_shader_folders *folders,
                           const char *file, fm_error *err)
{
    static const char common[] = "common/";
    const size_t length = sizeof common - 1;
    if (strchr(file, '/') == NULL)
        return path_join(path, folders->method, file, err);
    if (strncmp(file, common, length) == 0 && is_known(folders->common))
        return path_join(path, folders->common, file + length, err);
    const fm_status status = find_beside(path, folders->method, file, err);
    if (status != FM_OK || access(path, R_OK) == 0 || !is_known(folders->common))
        return status;
    char built_in[FM_PATH_MAX_BYTES];
    if (find_beside(built_in, folders->common, file, NULL) == FM_OK && access(built_in, R_OK) == 0)
        memcpy(path, built_in, sizeof built_in);
    return FM_OK;
}
