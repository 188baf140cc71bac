/* A folder that is made beside its place and renamed: it is there whole, or not at all. */
#ifndef FM_BUNDLE_STAGING_H
#define FM_BUNDLE_STAGING_H

#include <stdint.h>

#include "base/path.h"

/* FM_INVALID: the directory is there and not an empty folder, with the reason. */
fm_status staging_expect_free(const char *directory, fm_error *err);
/* Makes a folder of one's own beside `path`: root = PATH.partial-XXXXXX; slashes at its end do not
 * count. FM_IO; root is then "". */
fm_status staging_open(char root[FM_PATH_MAX_BYTES], const char *path, fm_error *err);
/* FM_IO: the disk of root has no room for so many bytes, which `what` takes. */
fm_status staging_expect_room(const char *root, uint64_t bytes, const char *what, fm_error *err);

#endif
