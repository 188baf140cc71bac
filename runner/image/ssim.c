#include <math.h>
#include <stdlib.h>

#include "filters.h"
#include "image_error.h"

enum { RADIUS = SSIM_WINDOW_PX / 2, TAPS = SSIM_WINDOW_PX };

/* What windows average, of the two images' values x and y. */
enum { X, Y, XX, YY, XY, MOMENTS };

/* Rows of one channel around the current one. */
typedef struct window {
    const fm_image *image, *reference;
    double weights[TAPS];
    size_t inner;            /* columns with a window */
    double *row[MOMENTS];    /* [width], one row before filtering */
    double *across[MOMENTS]; /* [TAPS][inner]: row r lies in slot r % TAPS */
    double *mean[MOMENTS];   /* [inner], of the current row */
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

static void add_row(window *w, size_t row, size_t channel)
{
    const size_t width = w->image->width_px;
    for (size_t i = 0; i < width; i++) {
        const double x = (double)w->image->rgba[(row * width + i) * 4 + channel];
        const double y = (double)w->reference->rgba[(row * width + i) * 4 + channel];
        w->row[X][i] = x;
        w->row[Y][i] = y;
        w->row[XX][i] = x * x;
        w->row[YY][i] = y * y;
        w->row[XY][i] = x * y;
    }
    for (int m = 0; m < MOMENTS; m++) {
        const double *taps[TAPS];
        for (int t = 0; t < TAPS; t++)
            taps[t] = w->row[m] + t;
        filter_rows_double(w->across[m] + row % TAPS * w->inner, taps, w->weights, TAPS, w->inner);
    }
}

static double similarity(const window *w, size_t i)
{
    const double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
    const double x = w->mean[X][i], y = w->mean[Y][i];
    const double variance_x = w->mean[XX][i] - x * x, variance_y = w->mean[YY][i] - y * y;
    const double covariance = w->mean[XY][i] - x * y;
    return (2.0 * x * y + c1) * (2.0 * covariance + c2) /
           ((x * x + y * y + c1) * (variance_x + variance_y + c2));
}

/* The windows around the pixels of a row, a channel's share of their mean. */
static void compare_row(float *map, window *w, size_t row)
{
    for (int m = 0; m < MOMENTS; m++) {
        const double *taps[TAPS];
        for (size_t t = 0; t < TAPS; t++)
            taps[t] = w->across[m] + (row + t - RADIUS) % TAPS * w->inner;
        filter_rows_double(w->mean[m], taps, w->weights, TAPS, w->inner);
    }
    for (size_t i = 0; i < w->inner; i++)
        map[i] += (float)(0.25 * similarity(w, i));
}

static void compare_channel(float *map, window *w, size_t channel)
{
    const size_t width = w->image->width_px;
    for (size_t row = 0; row < w->image->height_px; row++) {
        add_row(w, row, channel);
        if (row >= TAPS - 1)
            compare_row(map + (row - RADIUS) * width + RADIUS, w, row - RADIUS);
    }
}

/* NAN at the border, 0 where a window is. */
static void begin_map(float *map, size_t width, size_t height)
{
    for (size_t row = 0; row < height; row++)
        for (size_t i = 0; i < width; i++) {
            const bool is_inner =
                row >= RADIUS && row + RADIUS < height && i >= RADIUS && i + RADIUS < width;
            map[row * width + i] = is_inner ? 0.0f : NAN;
        }
}

fm_status image_ssim(float *map, const fm_image *image, const fm_image *reference, fm_error *err)
{
    const size_t width = image->width_px, height = image->height_px;
    begin_map(map, width, height);
    if (width < TAPS || height < TAPS)
        return FM_OK;
    window w = { .image = image, .reference = reference, .inner = width - (TAPS - 1) };
    const size_t a_moment = width + TAPS * w.inner + w.inner;
    double *memory = malloc(MOMENTS * a_moment * sizeof *memory);
    if (memory == NULL)
        return fm_fail(err, FM_NO_MEMORY, "ssim of %zu x %zu px", width, height);
    for (int m = 0; m < MOMENTS; m++) {
        w.row[m] = memory + (size_t)m * a_moment;
        w.across[m] = w.row[m] + width;
        w.mean[m] = w.across[m] + TAPS * w.inner;
    }
    gaussian(w.weights);
    for (size_t channel = 0; channel < 4; channel++)
        compare_channel(map, &w, channel);
    free(memory);
    return FM_OK;
}
