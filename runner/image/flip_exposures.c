/* Which exposures HDR-FLIP looks at: section 3 of Andersson et al. 2021. */
#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "colour.h"
#include "flip.h"
#include "flip_view.h"
#include "pool.h"

/* Of the luminances of an image in front of white. */
typedef struct brightness {
    double most, median; /* 0: the image is black */
} brightness;

static fm_status measure(brightness *found, const fm_image *image, fm_error *err)
{
    const size_t pixels = (size_t)image->width_px * image->height_px;
    float *values = malloc(2 * pixels * sizeof *values);
    *found = (brightness){ 0 };
    if (values == NULL)
        return fm_fail(err, FM_NO_MEMORY, "FLIP of %zu pixels", pixels);
    for (size_t i = 0; i < pixels; i++) {
        const float *rgba = image->rgba + 4 * i, behind = 1.0f - rgba[3];
        const float shown[3] = { rgba[0] + behind, rgba[1] + behind, rgba[2] + behind };
        const float luminance = colour_luminance(shown);
        values[i] = luminance > 0 ? fminf(luminance, FLT_MAX) : 0;
    }
    pool_sort(values, values + pixels, pixels);
    size_t black = 0;
    while (black < pixels && values[black] == 0)
        black++;
    const size_t middle =
        values[(pixels - 1) / 2] > 0 ? (pixels - 1) / 2 : black + (pixels - black - 1) / 2;
    if (black < pixels)
        *found = (brightness){ (double)values[pixels - 1], (double)values[middle] };
    free(values);
    return FM_OK;
}

int flip_exposures(double stops[FLIP_EXPOSURES_MOST], const flip_desc *desc, fm_error *err)
{
    brightness seen;
    fm_status status = measure(&seen, desc->reference, err);
    if (status == FM_OK && seen.most == 0)
        status = measure(&seen, desc->image, err);
    if (status != FM_OK)
        return 0;
    stops[0] = 0;
    if (seen.most == 0)
        return 1;
    const double tone = flip_tone_of_exposures();
    const double first = log2(tone / seen.most);
    const double last = fmin(log2(tone / seen.median), first + FLIP_EXPOSURES_MOST - 1);
    const double apart = ceil(last - first);
    const int count = apart < 2 ? 2 : (int)apart;
    for (int i = 0; i < count; i++)
        stops[i] = first + (last - first) * i / (count - 1);
    return count;
}
