#include "image_files.h"

#include <stdio.h>
#include <string.h>

#include "base/path.h"

static const char suffix[] = ".rgba32f";

fm_status image_files_write(const char *path, const fm_image *image, const fm_image *truth,
                            fm_error *err)
{
    char truth_path[FM_PATH_MAX_BYTES];
    const size_t length = strlen(path);
    if (length == 0)
        return FM_OK;
    if (length < sizeof suffix || length + sizeof ".truth" > sizeof truth_path)
        return fm_fail(err, FM_IO, "the image's path '%s' is too short or too long", path);
    snprintf(truth_path, sizeof truth_path, "%.*s.truth%s", (int)(length - sizeof suffix + 1), path,
             suffix);
    const fm_status status = image_write(path, image, err);
    return status == FM_OK && truth != NULL ? image_write(truth_path, truth, err) : status;
}
