/* FLIP once more, straight from the papers: two-dimensional filters, double precision, no care for
 * time. It shares nothing with runner/image/ but the image. */
#ifndef FM_TESTS_FLIP_SLOW_H
#define FM_TESTS_FLIP_SLOW_H

#include "image/image.h"

/* map: [height][width]. */
void flip_slow(double *map, const fm_image *image, const fm_image *reference,
               double pixels_per_degree);
/* The largest over these exposures, in stops. */
void flip_slow_hdr(double *map, const fm_image *image, const fm_image *reference,
                   double pixels_per_degree, const double *stops, int count);

#endif
