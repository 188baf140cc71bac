/* One of the two images, as it is shown. */
#ifndef FM_FLIP_VIEW_H
#define FM_FLIP_VIEW_H

#include <stdbool.h>
#include <stddef.h>

#include "image.h"

typedef struct flip_view {
    const fm_image *image;
    bool is_tone_mapped;
    float gain; /* 2^exposure, if it is */
} flip_view;

/* A row as linear RGB in [0,1], in front of white: rgb[channel][x]. */
void flip_view_row(float *const rgb[3], const flip_view *view, size_t row);

/* What the ACES curve maps to 0.85. */
double flip_tone_of_exposures(void);

#endif
