#include "path.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

fm_status path_join(char path[FM_PATH_MAX_BYTES], const char *folder, const char *name,
                    fm_error *err)
{
    const int length = snprintf(path, FM_PATH_MAX_BYTES, "%s/%s", folder, name);
    if (length >= 0 && length < FM_PATH_MAX_BYTES)
        return FM_OK;
    path[0] = '\0';
    return fm_fail(err, FM_INVALID, "%.64s.../%.64s: the path is longer than %d bytes", folder,
                   name, FM_PATH_MAX_BYTES - 1);
}

fm_status path_make_temporary(char path[FM_PATH_MAX_BYTES], const char *name, fm_error *err)
{
    char pattern[128];
    const char *variable = getenv("TMPDIR");
    const bool is_set = variable != NULL && variable[0] != '\0';
    const char *folder = is_set ? variable : "/tmp";
    snprintf(pattern, sizeof pattern, "%.100s-XXXXXX", name);
    fm_status status = path_join(path, folder, pattern, err);
    if (status == FM_OK && mkdtemp(path) == NULL) {
        status = fm_fail(err, FM_IO, "%s%s: no temporary folder can be made there: %s",
                         is_set ? "TMPDIR: " : "", folder, strerror(errno));
        path[0] = '\0';
    }
    return status;
}

bool path_beside(char *path, size_t room_bytes, const char *file, const char *name)
{
    const char *slash = name[0] == '/' ? NULL : strrchr(file, '/');
    const int folder_length = slash != NULL ? (int)(slash - file) + 1 : 0;
    const int length = snprintf(path, room_bytes, "%.*s%s", folder_length, file, name);
    return length >= 0 && (size_t)length < room_bytes;
}
