/* FLIP, the perceived difference of two images that are shown in turns: Andersson et al. 2020
 * (doi:10.1145/3406183) and, for images of high dynamic range, 2021 (doi:10.2312/sr.20211285).
 *
 * Our images are premultiplied; a person sees them in front of something. Here that is white, as in
 * the PNG files of a report: RGB is colour + (1 - alpha). Values are linear; FLIP of low range
 * clamps them to [0,1]. */
#ifndef FM_FLIP_H
#define FM_FLIP_H

#include <stdbool.h>

#include "image.h"

/* A 4K display 0.7 m wide, seen from 0.7 m. */
#define FLIP_PIXELS_PER_DEGREE      (0.7 * 3840 / 0.7 * 3.14159265358979323846 / 180)
#define FLIP_PIXELS_PER_DEGREE_MOST 1000
/* HDR-FLIP looks at no more exposures than this. */
enum { FLIP_EXPOSURES_MOST = 32 };

typedef struct flip_desc {
    const fm_image *image, *reference; /* of one size */
    double pixels_per_degree;          /* from 1 to the most; 0: FLIP_PIXELS_PER_DEGREE */
    bool is_hdr;
} flip_desc;

/* map: [height][width], the difference of each pixel, from 0 to 1.
 *
 * With is_hdr: the largest over exposures. They go, about a stop apart, from the one that brings
 * the reference's brightest pixel to 0.85 after tone mapping (ACES, by Narkowicz's fit) to the one
 * that brings its median there. Of a reference whose median is black the median of the other pixels
 * is taken; of a black one the image's, and of two black ones exposure 0 alone. A median that is
 * more than 31 stops below the brightest pixel is taken to be 31 stops below.
 *
 * FM_INVALID: sizes differ, a pixel is infinite or no number (the message has its column and row),
 * or pixels_per_degree is out of range. FM_NO_MEMORY. */
fm_status image_flip(float *map, const flip_desc *desc, fm_error *err);

/* The exposures of HDR-FLIP, in stops; returns how many, from 1 to FLIP_EXPOSURES_MOST.
 * FM_NO_MEMORY makes it 0. */
int flip_exposures(double stops[FLIP_EXPOSURES_MOST], const flip_desc *desc, fm_error *err);

#endif
