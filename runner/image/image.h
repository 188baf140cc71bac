/* Float images, and their files. The room image holds these and how far two are apart:
 * image_error.h has all measures, flip.h one of them. */
#ifndef FM_IMAGE_H
#define FM_IMAGE_H

#include <stdint.h>

#include "base/error.h"

/* RGBA floats, linear, premultiplied, row 0 at the top. */
typedef struct fm_image {
    uint32_t width_px, height_px;
    float *rgba; /* [height][width][4]; owned */
} fm_image;

/* All zero. FM_INVALID: no pixels, or more than 2^28. */
fm_status image_create(fm_image **image, uint32_t width_px, uint32_t height_px, fm_error *err);
void image_destroy(fm_image *image);

/* What an image in single precision may be off for rounding where up to n fragments of a pixel were
 * composited. */
double image_rounding(uint32_t n);

/* FM_INVALID: sizes differ. */
fm_status image_check_sizes(const fm_image *image, const fm_image *reference, fm_error *err);
/* FM_INVALID: sizes differ, or a pixel is infinite or no number; the message says which pixel of
 * which image. */
fm_status image_check_pair(const fm_image *image, const fm_image *reference, fm_error *err);

/* Raw file: "fragmark rgba32f WIDTH HEIGHT\n", then rows from the top, 16 little-endian bytes a
 * pixel. What fragmark-report turns into PNG and EXR. Written whole or not at all.
 * FM_INVALID: damaged or foreign file; FM_IO. */
fm_status image_write(const char *path, const fm_image *image, fm_error *err);
fm_status image_read(fm_image **image, const char *path, fm_error *err);

#endif
