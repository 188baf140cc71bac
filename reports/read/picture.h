/* Pictures that the runner kept: images/ID.rgba32f, what a case drew, and images/ID.truth.rgba32f,
 * what it was to draw. */
#ifndef FM_READ_PICTURE_H
#define FM_READ_PICTURE_H

#include "base/path.h"
#include "image/image.h"

/* path = DIRECTORY/images/ID ENDING. id: of a case, or another name of at most 64 bytes; ending:
 * ".truth.rgba32f", of at most 32. FM_INVALID: the path is too long. */
fm_status picture_path(char path[FM_PATH_MAX_BYTES], const char *directory, const char *id,
                       const char *ending, fm_error *err);

/* Reads a picture; *image is NULL, and no error, where it was not kept. FM_INVALID: damaged; FM_IO,
 * FM_NO_MEMORY. The caller destroys *image. */
fm_status picture_read(fm_image **image, const char *directory, const char *id, const char *ending,
                       fm_error *err);

/* The largest difference of a channel between what two cases drew; NAN on failure. FM_UNSUPPORTED:
 * one of them was not kept; FM_INVALID: damaged, or of different sizes. */
fm_status picture_compare(double *max_difference, const char *directory, const char *id,
                          const char *other, fm_error *err);

#endif
