/* Structural similarity, Wang et al. 2004 (doi:10.1109/TIP.2003.819861), on luminance. */
#include <math.h>
#include <stddef.h>
#include <stdlib.h>

#include "image.h"

enum { RADIUS = 5, TAPS = 2 * RADIUS + 1 };

/* What one pixel of the two images adds to the windowed means. */
typedef struct moments {
    double x, y, xx, yy, xy;
} moments;

/* Horizontally filtered rows around the current one: row r lies in slot r % TAPS. */
typedef struct window {
    const fm_image *image, *reference;
    double weights[TAPS];
    moments *pixels; /* [width], one row before filtering */
    moments *rows;   /* [TAPS][width] */
} window;

static void gaussian(double weights[TAPS])
{
    const double sigma = 1.5;
    double sum = 0.0;
    for (int i = 0; i < TAPS; i++) {
        const double distance = i - RADIUS;
        weights[i] = exp(-distance * distance / (2.0 * sigma * sigma));
        sum += weights[i];
    }
    for (int i = 0; i < TAPS; i++)
        weights[i] /= sum;
}

/* Rec. 709 on linear values. */
static double luminance(const float *rgba)
{
    return 0.2126 * (double)rgba[0] + 0.7152 * (double)rgba[1] + 0.0722 * (double)rgba[2];
}

static void add_weighted(moments *sum, const moments *m, double weight)
{
    sum->x += weight * m->x;
    sum->y += weight * m->y;
    sum->xx += weight * m->xx;
    sum->yy += weight * m->yy;
    sum->xy += weight * m->xy;
}

static size_t clamped(size_t centre, int tap, size_t count)
{
    const ptrdiff_t i = (ptrdiff_t)centre + tap - RADIUS;
    if (i < 0)
        return 0;
    return (size_t)i < count ? (size_t)i : count - 1;
}

static void filter_row(window *w, size_t row)
{
    const size_t width = w->image->width_px;
    for (size_t i = 0; i < width; i++) {
        const double x = luminance(w->image->rgba + (row * width + i) * 4);
        const double y = luminance(w->reference->rgba + (row * width + i) * 4);
        w->pixels[i] = (moments){ x, y, x * x, y * y, x * y };
    }
    moments *filtered = w->rows + row % TAPS * width;
    for (size_t i = 0; i < width; i++) {
        filtered[i] = (moments){ 0 };
        for (int tap = 0; tap < TAPS; tap++)
            add_weighted(&filtered[i], &w->pixels[clamped(i, tap, width)], w->weights[tap]);
    }
}

static double similarity(const moments *m)
{
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double variance_x = m->xx - m->x * m->x, variance_y = m->yy - m->y * m->y;
    const double covariance = m->xy - m->x * m->y;
    return (2.0 * m->x * m->y + c1) * (2.0 * covariance + c2) /
           ((m->x * m->x + m->y * m->y + c1) * (variance_x + variance_y + c2));
}

static double sum_row(const window *w, size_t row)
{
    const size_t width = w->image->width_px, height = w->image->height_px;
    double sum = 0.0;
    for (size_t i = 0; i < width; i++) {
        moments mean = { 0 };
        for (int tap = 0; tap < TAPS; tap++)
            add_weighted(&mean, w->rows + clamped(row, tap, height) % TAPS * width + i,
                         w->weights[tap]);
        sum += similarity(&mean);
    }
    return sum;
}

fm_status image_ssim(double *ssim, const fm_image *image, const fm_image *reference, fm_error *err)
{
    const size_t width = image->width_px, height = image->height_px;
    fm_status status = FM_OK;
    window w = { .image = image,
                 .reference = reference,
                 .pixels = calloc(width, sizeof(moments)),
                 .rows = calloc(width * TAPS, sizeof(moments)) };
    if (w.pixels == NULL || w.rows == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "ssim: a window of %zu px", width * TAPS);
        goto out;
    }
    gaussian(w.weights);
    double sum = 0.0;
    size_t filtered = 0;
    for (size_t row = 0; row < height; row++) {
        for (; filtered < height && filtered <= row + RADIUS; filtered++)
            filter_row(&w, filtered);
        sum += sum_row(&w, row);
    }
    *ssim = sum / ((double)width * (double)height);
out:
    free(w.pixels);
    free(w.rows);
    return status;
}
