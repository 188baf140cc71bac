/* What an image is compared with: of all pictures that truth allows the nearest to it. Where no
 * depths tie there is one such picture; else each channel of a pixel has an interval (ties.h), and
 * an image's error is its distance to that: 0 within it.
 *
 * Exposure (the key of that name) is applied here and nowhere else, to both sides of a comparison:
 * fragments stay RGBA8, and the finished pictures are scaled before any metric sees them. What is
 * nearest stays so, since an interval's ends are scaled as what lies between them. Whether an exact
 * method is right is judged without it. */
#ifndef FM_REFERENCE_H
#define FM_REFERENCE_H

#include "image/image_error.h"
#include "rounding.h"
#include "ties.h"
#include "truth.h"

typedef struct fm_reference {
    fm_image *wanted; /* of the k nearest fragments; owned */
    fm_image *all;    /* of all fragments; owned */
    /* rmse of the k nearest against all of them, both in truth's own order */
    double truncation_rmse;
    double truncation_square[2]; /* the same, squared: the part of the colours, and of alpha */
} fm_reference;

/* wanted: how many fragments of a pixel, from the front; UINT32_MAX: all. image: as large as truth.
 * reference_free also after a failure: FM_NO_MEMORY, FM_INVALID (sizes). */
fm_status reference_create(fm_reference *reference, const fm_truth *truth, uint32_t wanted,
                           const fm_image *image, fm_error *err);
void reference_free(fm_reference *reference);

/* Scales the colours of the reference's pictures and of the image that it was made for by
 * 2^stops; alpha stays. The metrics of exposed pictures are those of high dynamic range. */
void reference_expose(fm_reference *reference, fm_image *image, double stops);

/* Images of one case. */
typedef struct reference_images {
    const fm_truth *truth;
    uint32_t wanted; /* as above */
    uint32_t traits; /* FM_TRAIT_LOSES_*: pixels that these may touch are left out */
    fm_rounding rounding;
    fm_image *const *images;
    size_t count;
} reference_images;

/* The largest distance of any channel of any of the images from what truth allows of the wanted
 * fragments, less what `rounding` may move the pixel by; INFINITY: a channel is no number.
 * FM_NO_MEMORY. */
fm_status reference_distance(double *max_abs, const reference_images *compared, fm_error *err);

/* Of each image what image_difference finds against the pictures that reference_create makes for
 * it, exposed by `stops`: bit by bit the same, in one pass over truth for all images; traits and
 * rounding play no part. *worst: at least what it was. FM_NO_MEMORY. */
fm_status reference_worst(fm_worst_error *worst, const reference_images *compared, double stops,
                          fm_error *err);

/* Scales an image's colours by 2^stops; alpha stays. */
void reference_expose_image(fm_image *image, double stops);

/* The distance of one pixel's channels from a range: the largest; INFINITY as above. */
double range_distance(const fm_range *range, const float rgba[4]);

/* Pixels where ties leave the order, or the choice, of the wanted fragments open. */
uint64_t truth_tied_pixels(const fm_truth *truth, uint32_t wanted);

#endif
