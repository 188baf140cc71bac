/* Paths of files, in buffers of fixed size. */
#ifndef FM_PATH_H
#define FM_PATH_H

#include <stdbool.h>
#include <stddef.h>

#include "error.h"

enum { FM_PATH_MAX_BYTES = 1024 }; /* with the NUL; longer paths are refused */

/* path = folder/name. FM_INVALID: longer than FM_PATH_MAX_BYTES; path is then "". */
fm_status path_join(char path[FM_PATH_MAX_BYTES], const char *folder, const char *name,
                    fm_error *err);

/* Makes a folder of one's own for files that nobody keeps, in TMPDIR or /tmp; its name begins with
 * `name`. FM_IO: naming TMPDIR if it is to blame; FM_INVALID: too long. path is then "". */
fm_status path_make_temporary(char path[FM_PATH_MAX_BYTES], const char *name, fm_error *err);

/* `name` as seen from the folder of `file`: absolute names stay. false: longer than the room. */
bool path_beside(char *path, size_t room_bytes, const char *file, const char *name);

/* FM_OK: a folder that may be read. FM_IO: "PATH: Permission denied", "PATH: is not a folder". */
fm_status path_is_folder(const char *path, fm_error *err);

/* Like mkdir -p. FM_INVALID names the folder that could not be made, and why; FM_IO: the disk is
 * full. */
fm_status path_make_folders(const char *path, fm_error *err);

#endif
