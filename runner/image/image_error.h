/* How far two images are apart, by several measures, over the viewport and over covered pixels. */
#ifndef FM_IMAGE_ERROR_H
#define FM_IMAGE_ERROR_H

#include <stdbool.h>

#include "image.h"
#include "pool.h"

/* Over all channels, premultiplied, alpha among them. */
typedef struct fm_difference {
    double rmse;
    double psnr_db; /* peak 1; INFINITY for equal images */
    double max_abs;
} fm_difference;

/* The largest errors of several images of one case, perhaps of three different ones. */
typedef struct fm_worst_error {
    double rmse, max_abs; /* against the pictures of the wanted fragments */
    double total_rmse;    /* against those of all fragments */
} fm_worst_error;

/* Where. Pixels that nothing covers are right whatever the method does; over a viewport that is
 * mostly empty they hide its errors. */
typedef enum fm_region { FM_REGION_VIEWPORT, FM_REGION_COVERED, FM_REGION_COUNT } fm_region;

typedef struct fm_region_error {
    uint64_t pixels; /* 0: all numbers are NAN */
    fm_difference difference;
    fm_pooled absolute; /* of a pixel: its largest channel's error */
    double ssim;        /* mean over the windows around the region's pixels; NAN: there is none */
    fm_pooled flip;     /* flip.h; of its map over the viewport, pooled over the region */
} fm_region_error;

typedef struct fm_image_error {
    fm_region_error region[FM_REGION_COUNT];
} fm_image_error;

typedef struct image_compare_desc {
    const fm_image *image, *reference;
    const bool *covered;      /* [height][width]; NULL: all pixels are */
    double pixels_per_degree; /* of FLIP; 0: its default */
    bool is_hdr;              /* values beyond 1 count: HDR-FLIP */
    /* [height][width] each; NULL: not wanted. NAN where ssim has no window. */
    float *absolute_map, *ssim_map, *flip_map;
} image_compare_desc;

/* If a pixel is not finite, rmse and errors are infinite, psnr_db is -INFINITY, ssim 0 and the maps
 * of ssim and FLIP are NAN: whoever cannot have that asks image_check_pair before.
 * FM_INVALID: sizes differ, or as image_flip says; FM_NO_MEMORY. */
fm_status image_compare(fm_image_error *error, const image_compare_desc *desc, fm_error *err);

/* The first measures alone, pixel by pixel: whoever has no picture to compare with adds what it
 * would hold. Starts as {0}. */
typedef struct difference_sums {
    double squares, most;
    uint64_t pixels;
} difference_sums;
/* Adds a pixel; returns the error of its worst channel. One that is no number is infinite. */
float difference_add(difference_sums *sums, const float image[4], const float reference[4]);
/* All are NAN if no pixel was added. */
fm_difference difference_of(const difference_sums *sums);

/* The same of whole images, over the viewport. FM_INVALID: sizes differ. */
fm_status image_difference(fm_difference *difference, const fm_image *image,
                           const fm_image *reference, fm_error *err);

/* Across and down, of ssim's windows. */
enum { SSIM_WINDOW_PX = 11 };

/* Structural similarity, Wang et al. 2004 (doi:10.1109/TIP.2003.819861): windows of 11 x 11
 * weighted by a Gaussian of deviation 1.5, K1 = 0.01, K2 = 0.03, range 1, covariance divided by the
 * sum of weights; each channel by itself, then their mean. Windows lie within the image, so that a
 * border of 5 pixels has none: NAN. Images of fewer than 11 pixels across have none at all. map:
 * [height][width]; the images are finite and of one size. FM_NO_MEMORY. */
fm_status image_ssim(float *map, const fm_image *image, const fm_image *reference, fm_error *err);

#endif
