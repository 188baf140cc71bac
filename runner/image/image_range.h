/* What several images of one size reach: of each channel of each pixel the least and the most. How
 * far frames of one case are apart is the difference of these two. */
#ifndef FM_IMAGE_RANGE_H
#define FM_IMAGE_RANGE_H

#include "image.h"

/* Starts as {0}: of no image. A value that is no number counts as infinite. */
typedef struct fm_image_range {
    fm_image *low, *high; /* owned; NULL: of no image */
} fm_image_range;

/* Takes an image in. FM_INVALID: its size is another; FM_NO_MEMORY. */
fm_status image_range_add(fm_image_range *range, const fm_image *image, fm_error *err);
/* Takes in all that another range reaches; one of no image changes nothing. The same errors. */
fm_status image_range_join(fm_image_range *range, const fm_image_range *more, fm_error *err);
void image_range_free(fm_image_range *range);

/* The endings of the two files of a range. */
#define FM_RANGE_LOW_ENDING  ".low.rgba32f"
#define FM_RANGE_HIGH_ENDING ".high.rgba32f"

/* Writes PREFIX and each ending (image_write). One of no image removes them. prefix "": nothing is
 * done. FM_IO: not written, or the path is too long. */
fm_status image_range_write(const char *prefix, const fm_image_range *range, fm_error *err);
/* Reads them; *range is of no image where one of them is not there. FM_INVALID: damaged, or
 * of different sizes; FM_IO, FM_NO_MEMORY. image_range_free in any case. */
fm_status image_range_read(fm_image_range *range, const char *prefix, fm_error *err);

#endif
