#include "file.h"

#include <errno.h>
#include <fcntl.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

static const char *kind_of(mode_t mode)
{
    return S_ISDIR(mode)    ? "a folder"
           : S_ISFIFO(mode) ? "a pipe"
           : S_ISSOCK(mode) ? "a socket"
                            : "a device";
}

static fm_status refuse(const char *path, mode_t mode, fm_status status, fm_error *err)
{
    return fm_fail(err, status, "%s: is %s, not a file", path, kind_of(mode));
}

/* Without waiting for a pipe's other end; what it is, is asked of what was opened. What is to be
 * read was chosen by a user, who is told of a wrong choice; what is to be written is our own. */
static fm_status open_regular(int *fd, struct stat *info, const char *path, int flags,
                              fm_error *err)
{
    const fm_status refusal = (flags & O_CREAT) != 0 ? FM_IO : FM_INVALID;
    const int opened = open(path, flags | O_NONBLOCK | O_NOCTTY | O_CLOEXEC, 0666);
    if (opened < 0) {
        const int reason = errno;
        if (stat(path, info) == 0 && !S_ISREG(info->st_mode))
            return refuse(path, info->st_mode, refusal, err);
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(reason));
    }
    if (fstat(opened, info) == 0 && S_ISREG(info->st_mode)) {
        *fd = opened;
        return FM_OK;
    }
    close(opened);
    return refuse(path, info->st_mode, refusal, err);
}

fm_status file_open(int *fd, uint64_t *size_bytes, const char *path, fm_error *err)
{
    struct stat info = { .st_size = 0 };
    const fm_status status = open_regular(fd, &info, path, O_RDONLY, err);
    if (status == FM_OK && size_bytes != NULL)
        *size_bytes = (uint64_t)info.st_size;
    return status;
}

fm_status file_open_stream(FILE **file, const char *path, fm_error *err)
{
    int fd = -1;
    *file = NULL;
    const fm_status status = file_open(&fd, NULL, path, err);
    if (status != FM_OK)
        return status;
    *file = fdopen(fd, "rb");
    if (*file != NULL)
        return FM_OK;
    close(fd);
    return fm_fail(err, FM_NO_MEMORY, "%s: no memory to read it", path);
}

fm_status file_create(int *fd, const char *path, fm_error *err)
{
    struct stat info = { .st_size = 0 };
    int opened = -1;
    const fm_status status = open_regular(&opened, &info, path, O_WRONLY | O_CREAT, err);
    if (status != FM_OK)
        return status;
    if (info.st_size > 0 && ftruncate(opened, 0) != 0) { /* not by O_TRUNC, before it is known */
        const int reason = errno;
        close(opened);
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(reason));
    }
    *fd = opened;
    return FM_OK;
}

fm_status file_open_append(int *fd, const char *path, fm_error *err)
{
    struct stat info = { .st_size = 0 };
    return open_regular(fd, &info, path, O_RDWR | O_CREAT | O_APPEND, err);
}

fm_status file_check_replaceable(const char *path, fm_error *err)
{
    struct stat info;
    if (stat(path, &info) == 0 && !S_ISREG(info.st_mode))
        return refuse(path, info.st_mode, FM_IO, err);
    return FM_OK;
}
