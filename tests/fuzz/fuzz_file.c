#include <stdio.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <unistd.h>

#include "fuzz.h"

void fuzz_file_open(fuzz_file *file, const uint8_t *bytes, size_t count)
{
    file->fd = memfd_create("fuzz", MFD_CLOEXEC);
    if (file->fd < 0 || (count > 0 && write(file->fd, bytes, count) != (ssize_t)count)) {
        perror("memfd");
        abort();
    }
    snprintf(file->path, sizeof file->path, "/proc/self/fd/%d", file->fd);
}

void fuzz_file_close(const fuzz_file *file)
{
    close(file->fd);
}

void fuzz_expect_reason(fm_status status, const fm_error *err)
{
    if (status == FM_OK || (status == err->status && err->message[0] != '\0'))
        return;
    fprintf(stderr, "status %d, but the error says %d, \"%s\"\n", status, err->status,
            err->message);
    abort();
}
