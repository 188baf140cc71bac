/* Float images and how far two of them are apart. */
#ifndef FM_IMAGE_H
#define FM_IMAGE_H

#include <stdint.h>

#include "error.h"

/* RGBA floats, linear, premultiplied, row 0 at the top. */
typedef struct fm_image {
    uint32_t width_px, height_px;
    float *rgba; /* [height][width][4]; owned */
} fm_image;

typedef struct fm_image_error {
    double rmse;    /* over all channels and pixels */
    double psnr_db; /* peak 1; INFINITY for equal images */
    double max_abs;
    double ssim; /* mean over pixels of luminance SSIM, 11 x 11 Gaussian window, sigma 1.5
                    (Wang et al. 2004, K1 = 0.01, K2 = 0.03, range 1), borders clamped */
} fm_image_error;

/* All zero. FM_INVALID: no pixels, or more than 2^28. */
fm_status image_create(fm_image **image, uint32_t width_px, uint32_t height_px, fm_error *err);
void image_destroy(fm_image *image);

/* FM_INVALID: sizes differ. Pixels that are not finite make rmse and max_abs infinite,
 * psnr_db -INFINITY and ssim 0. */
fm_status image_compare(fm_image_error *error, const fm_image *image, const fm_image *reference,
                        fm_error *err);
/* The mean of error->ssim alone (ssim.c); sizes must agree. FM_NO_MEMORY. */
fm_status image_ssim(double *ssim, const fm_image *image, const fm_image *reference, fm_error *err);

/* Raw file: "fragmark rgba32f WIDTH HEIGHT\n", then rows from the top, 16 little-endian bytes a
 * pixel. What fragmark-report turns into PNG and EXR. Written whole or not at all.
 * FM_INVALID: damaged or foreign file; FM_IO. */
fm_status image_write(const char *path, const fm_image *image, fm_error *err);
fm_status image_read(fm_image **image, const char *path, fm_error *err);

#endif
