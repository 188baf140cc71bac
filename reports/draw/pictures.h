/* images/: the raw pictures that the runner wrote become PNG, EXR and heat maps. */
#ifndef FM_PICTURES_H
#define FM_PICTURES_H

#include <stdbool.h>

#include "image/image.h"

/* Heat maps show the largest difference over the four channels on one scale for all cases. */
#define FM_HEAT_LOW  1e-4
#define FM_HEAT_HIGH 1.0

/* What a heat map shows. */
typedef struct fm_heat {
    double most;  /* over channels and pixels; NAN: there is no map */
    double share; /* of pixels above FM_HEAT_LOW */
} fm_heat;

typedef struct fm_picture_set {
    bool has_result, has_truth; /* heat map of their difference: both */
    bool has_range;             /* frames drew different images */
    fm_heat difference;
    fm_heat range; /* of each pixel the most of all frames less the least */
} fm_picture_set;

/* Reads images/ID.rgba32f and images/ID.truth.rgba32f under directory, where they are, and writes
 * images/ID.png, ID.exr, ID.truth.png, ID.truth.exr, ID.difference.png and ID.difference.exr. Of
 * ID.low.rgba32f and ID.high.rgba32f (image/image_range.h) it writes ID.range.png and ID.range.exr.
 * PNGs are sRGB over white. A missing picture is no error; FM_INVALID: damaged, or of different
 * sizes. */
fm_status pictures_write(fm_picture_set *set, const char *directory, const char *id, fm_error *err);

/* Which colour a map's values have. */
typedef enum fm_map_scale {
    FM_MAP_DECADES,   /* as heat maps */
    FM_MAP_SHARE,     /* from 0 to 1 */
    FM_MAP_SIMILARITY /* from 1 to 0, and where there is no number */
} fm_map_scale;

/* Writes a map of errors, [height][width] of the image's size, as PREFIX.NAME.exr (grey, its
 * values) and PREFIX.NAME.png (coloured by the scale). FM_IO, FM_NO_MEMORY. */
fm_status pictures_write_map(const char *prefix, const char *name, const float *map,
                             const fm_image *size, fm_map_scale scale, fm_error *err);

/* images/heat-scale.png: the colour bar of all heat maps, FM_HEAT_LOW at the left. */
fm_status pictures_write_scale(const char *directory, fm_error *err);

#endif
