#include "path.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

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

fm_status path_is_folder(const char *path, fm_error *err)
{
    struct stat info;
    if (stat(path, &info) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    if (!S_ISDIR(info.st_mode))
        return fm_fail(err, FM_IO, "%s: is not a folder", path);
    if (access(path, R_OK | X_OK) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    return FM_OK;
}

static fm_status make_folder(const char *path, fm_error *err)
{
    struct stat info;
    if (mkdir(path, 0777) == 0)
        return FM_OK;
    const int cause = errno;
    const bool is_there = stat(path, &info) == 0;
    if (is_there && S_ISDIR(info.st_mode))
        return FM_OK;
    /* A full disk is not what was asked for wrongly. */
    return fm_fail(err, cause == ENOSPC || cause == EDQUOT ? FM_IO : FM_INVALID,
                   is_there ? "%s: is there, and is no folder" : "%s: cannot be made: %s", path,
                   strerror(cause));
}

fm_status path_make_folders(const char *path, fm_error *err)
{
    char part[FM_PATH_MAX_BYTES];
    fm_status status = FM_OK;
    snprintf(part, sizeof part, "%s", path);
    for (char *slash = strchr(part + 1, '/'); slash != NULL && status == FM_OK;
         slash = strchr(slash + 1, '/')) {
        *slash = '\0';
        status = make_folder(part, err);
        *slash = '/';
    }
    return status == FM_OK ? make_folder(part, err) : status;
}
