/* Files that are opened by a path which others chose.
 *
 * Only regular files are opened, also behind symbolic links: a device or a pipe may never end, and
 * opening a pipe may wait for ever. FM_INVALID when read, FM_IO when written: the path is a folder,
 * a device, a pipe or a socket, and the message says which. FM_IO: it cannot be opened, with the
 * system's reason. */
#ifndef FM_FILE_H
#define FM_FILE_H

#include <stdint.h>
#include <stdio.h>

#include "error.h"

/* To be read from its start. The caller closes *fd. size_bytes may be NULL; files of /proc say 0
 * and hold more. */
fm_status file_open(int *fd, uint64_t *size_bytes, const char *path, fm_error *err);
/* The same as a stream, which the caller closes. */
fm_status file_open_stream(FILE **file, const char *path, fm_error *err);
/* To be written: made, or emptied. */
fm_status file_create(int *fd, const char *path, fm_error *err);
/* To be read, and written at its end: made where there is none, and never emptied. */
fm_status file_open_append(int *fd, const char *path, fm_error *err);
/* Whether the path is free or a regular file, so that a file may take its place. */
fm_status file_check_replaceable(const char *path, fm_error *err);

#endif
