#include "staging.h"

#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>

enum { SPARE_BYTES = 1 << 20 };

fm_status staging_expect_free(const char *directory, fm_error *err)
{
    bool is_empty = true;
    DIR *folder = opendir(directory);
    if (folder == NULL && errno == ENOENT)
        return FM_OK;
    if (folder == NULL)
        return fm_fail(err, FM_INVALID, "%s: %s", directory,
                       errno == ENOTDIR ? "is not a folder" : strerror(errno));
    for (const struct dirent *entry; (entry = readdir(folder)) != NULL;)
        is_empty =
            is_empty && (strcmp(entry->d_name, ".") == 0 || strcmp(entry->d_name, "..") == 0);
    closedir(folder);
    return is_empty ? FM_OK
                    : fm_fail(err, FM_INVALID, "%s: is not empty; name a new folder", directory);
}

fm_status staging_open(char root[FM_PATH_MAX_BYTES], const char *path, fm_error *err)
{
    size_t end = strlen(path);
    while (end > 1 && path[end - 1] == '/')
        end--;
    const int length = snprintf(root, FM_PATH_MAX_BYTES, "%.*s.partial-XXXXXX", (int)end, path);
    fm_status status = FM_OK;
    if (length >= FM_PATH_MAX_BYTES - 32)
        status = fm_fail(err, FM_IO, "%.64s...: the path is too long", path);
    else if (mkdtemp(root) == NULL || chmod(root, 0755) != 0)
        status = fm_fail(err, FM_IO, "%s: %s", root, strerror(errno));
    if (status != FM_OK)
        root[0] = '\0';
    return status;
}

fm_status staging_expect_room(const char *root, uint64_t bytes, const char *what, fm_error *err)
{
    struct statvfs disk;
    if (statvfs(root, &disk) != 0)
        return fm_fail(err, FM_IO, "%s: %s", root, strerror(errno));
    const uint64_t room = (uint64_t)disk.f_bavail * disk.f_frsize;
    bytes += SPARE_BYTES;
    return room >= bytes ? FM_OK
                         : fm_fail(err, FM_IO, "%s takes %.1f MB, and %.1f MB are free", what,
                                   (double)bytes / 1e6, (double)room / 1e6);
}
