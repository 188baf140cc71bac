/* The filters of FLIP for a number of pixels per degree. */
#ifndef FM_FLIP_KERNELS_H
#define FM_FLIP_KERNELS_H

#include "filters.h"
#include "flip.h"

/* Radii: ceil(3 * sqrt(0.04 / (2 pi^2)) * pixels per degree) of blue and yellow, the widest, and
 * ceil(3 * 0.041 * pixels per degree) of features. */
_Static_assert(FILTER_RADIUS_MOST >= FLIP_PIXELS_PER_DEGREE_MOST * 136 / 1000,
               "room for the widest");

/* How sharply the eye sees, by frequency and channel (2020, section 4.1.1): sums of Gaussians, each
 * separable and of sum 1, with the shares that their sum has in the channel's filter. */
typedef enum flip_gaussian {
    FLIP_ACHROMATIC,
    FLIP_RED_GREEN,
    FLIP_BLUE_YELLOW,
    FLIP_BLUE_YELLOW_NARROW,
    FLIP_GAUSSIANS
} flip_gaussian;

/* Edges and points of the achromatic channel (section 4.2.1): a first and a second derivative, each
 * of sum 1 above and below 0, along one axis, smoothed along the other. */
typedef enum flip_feature { FLIP_SMOOTH, FLIP_EDGE, FLIP_POINT, FLIP_FEATURES } flip_feature;

typedef struct flip_kernels {
    filter_kernel gaussian[FLIP_GAUSSIANS];
    float
        narrow_share; /* of FLIP_BLUE_YELLOW_NARROW in its channel; FLIP_BLUE_YELLOW has the rest */
    filter_kernel feature[FLIP_FEATURES];
    int radius; /* the largest of all */
} flip_kernels;

/* pixels_per_degree: from 1 to FLIP_PIXELS_PER_DEGREE_MOST. */
void flip_kernels_make(flip_kernels *kernels, double pixels_per_degree);

#endif
