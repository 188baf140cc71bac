/* The pictures that a launch leaves for the report. */
#ifndef FM_IMAGE_FILES_H
#define FM_IMAGE_FILES_H

#include "image.h"

/* Writes the image to path, NAME.rgba32f, and its truth beside it, NAME.truth.rgba32f.
 * path    "": nothing is written
 * truth   NULL: the image alone
 * FM_IO: not written, or the path is too short or too long. */
fm_status image_files_write(const char *path, const fm_image *image, const fm_image *truth,
                            fm_error *err);

#endif
