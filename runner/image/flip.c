#include "flip.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "colour.h"
#include "filters.h"
#include "flip_kernels.h"
#include "flip_view.h"

/* Section 4.1.2 and 4.2.2: the exponents of colours and features, and where the steep part of the
 * colour scale ends: a share p_c of the largest difference becomes p_t. */
static const float q_c = 0.7f, p_c = 0.4f, p_t = 0.95f;

/* Planes of a row that is filtered across: one a Gaussian, then one a feature. */
enum { PLANES = FLIP_GAUSSIANS + FLIP_FEATURES };

/* What is known of one of the two images around the current row. */
typedef struct side {
    flip_view view;
    float *across[PLANES]; /* [ring][width]: row r lies in slot r % ring */
    float *lab[3];         /* [width], of the current row */
    float *edge, *point;   /* [width], likewise: magnitudes */
} side;

typedef struct matrix {
    float row[3][3];
} matrix;

typedef struct work {
    flip_kernels kernels;
    size_t width, height, ring, pad; /* pad: pixels beside a row's ends */
    matrix to_xyz, to_rgb;           /* relative to white */
    float difference_most;           /* c_max: green against blue, to the power q_c */
    side sides[2];
    float *padded[3]; /* [pad + width + pad]: YCxCz of one row */
    float *seen[3];   /* [width]: what the eye's filters leave of a row, in YCxCz, then in RGB */
    float *line;      /* [width]: one filter's result */
    const float **taps;
    float *memory;
} work;

static void invert(matrix *inverse, double m[3][3])
{
    double minor[3][3], determinant = 0;
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++) {
            const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
            minor[i][j] = m[a][c] * m[b][d] - m[a][d] * m[b][c];
        }
    for (int j = 0; j < 3; j++)
        determinant += m[0][j] * minor[0][j];
    for (int i = 0; i < 3; i++)
        for (int j = 0; j < 3; j++)
            inverse->row[j][i] = (float)(minor[i][j] / determinant);
}

/* Matrices between RGB and XYZ over white. */
static void make_matrices(work *w)
{
    double relative[3][3];
    for (int i = 0; i < 3; i++) {
        const double white = colour_xyz[i][0] + colour_xyz[i][1] + colour_xyz[i][2];
        for (int j = 0; j < 3; j++) {
            relative[i][j] = colour_xyz[i][j] / white;
            w->to_xyz.row[i][j] = (float)relative[i][j];
        }
    }
    invert(&w->to_rgb, relative);
}

static float curve(const float row[3], float r, float g, float b)
{
    return colour_lab_curve(row[0] * r + row[1] * g + row[2] * b);
}

/* CIELab with its chroma scaled by lightness, as Hunt found that we see it. */
static void lab_of(float *const lab[3], const matrix *to_xyz, float *const rgb[3], size_t count)
{
    const float *restrict const r = rgb[0], *restrict const g = rgb[1], *restrict const b = rgb[2];
    float *restrict const lightness = lab[0], *restrict const red_green = lab[1];
    float *restrict const blue_yellow = lab[2];
    for (size_t i = 0; i < count; i++) {
        const float x = curve(to_xyz->row[0], r[i], g[i], b[i]);
        const float y = curve(to_xyz->row[1], r[i], g[i], b[i]);
        const float z = curve(to_xyz->row[2], r[i], g[i], b[i]);
        lightness[i] = 116.0f * y - 16.0f;
        red_green[i] = 0.01f * lightness[i] * (500.0f * (x - y));
        blue_yellow[i] = 0.01f * lightness[i] * (200.0f * (y - z));
    }
}

/* HyAB: distance of lightness plus distance of chroma. */
static float distance(float *const a[3], float *const b[3], size_t i)
{
    const float da = a[1][i] - b[1][i], db = a[2][i] - b[2][i];
    return fabsf(a[0][i] - b[0][i]) + sqrtf(da * da + db * db);
}

static float largest_difference(const work *w)
{
    enum { GREEN, BLUE, COLOURS };
    float red[COLOURS] = { 0 }, green[COLOURS] = { 1, 0 }, blue[COLOURS] = { 0, 1 };
    float l[COLOURS], a[COLOURS], b[COLOURS];
    lab_of((float *const[]){ l, a, b }, &w->to_xyz, (float *const[]){ red, green, blue }, COLOURS);
    return powf(distance((float *const[]){ l, a, b }, (float *const[]){ l + 1, a + 1, b + 1 }, 0),
                q_c);
}

static float *take(float **memory, size_t count)
{
    float *taken = *memory;
    *memory += count;
    return taken;
}

static fm_status work_create(work *w, const flip_desc *desc, fm_error *err)
{
    const double asked = desc->pixels_per_degree;
    flip_kernels_make(&w->kernels, asked > 0 ? asked : FLIP_PIXELS_PER_DEGREE);
    w->width = desc->image->width_px;
    w->height = desc->image->height_px;
    w->pad = (size_t)w->kernels.radius;
    w->ring = 2 * w->pad + 1;
    const size_t rings = 2 * PLANES * w->ring * w->width, rows = (2 * 5 + 3 + 1) * w->width;
    const size_t padded = 3 * (w->width + 2 * w->pad);
    w->memory = malloc((rings + rows + padded) * sizeof *w->memory);
    w->taps = malloc(w->ring * sizeof *w->taps);
    if (w->memory == NULL || w->taps == NULL)
        return fm_fail(err, FM_NO_MEMORY, "FLIP of %zu x %zu px", w->width, w->height);
    float *left = w->memory;
    for (int s = 0; s < 2; s++) {
        side *one = &w->sides[s];
        for (int plane = 0; plane < PLANES; plane++)
            one->across[plane] = take(&left, w->ring * w->width);
        for (int c = 0; c < 3; c++)
            one->lab[c] = take(&left, w->width);
        one->edge = take(&left, w->width);
        one->point = take(&left, w->width);
    }
    for (int c = 0; c < 3; c++)
        w->padded[c] = take(&left, w->width + 2 * w->pad);
    for (int c = 0; c < 3; c++)
        w->seen[c] = take(&left, w->width);
    w->line = take(&left, w->width);
    make_matrices(w);
    w->difference_most = largest_difference(w);
    return FM_OK;
}

static void work_destroy(work *w)
{
    free(w->memory);
    free(w->taps);
}

/* Linear RGB becomes YCxCz in its place. */
static void to_ycxcz(const work *w, float *const rows[3])
{
    float *restrict const r = rows[0], *restrict const g = rows[1], *restrict const b = rows[2];
    for (size_t i = 0; i < w->width; i++) {
        float xyz[3];
        for (int c = 0; c < 3; c++)
            xyz[c] = w->to_xyz.row[c][0] * r[i] + w->to_xyz.row[c][1] * g[i] +
                     w->to_xyz.row[c][2] * b[i];
        r[i] = 116.0f * xyz[1] - 16.0f;
        g[i] = 500.0f * (xyz[0] - xyz[1]);
        b[i] = 200.0f * (xyz[1] - xyz[2]);
    }
}

/* Fills padded with a row in YCxCz; beyond its ends its last pixels go on. */
static void load_row(work *w, const flip_view *view, size_t row)
{
    float *const inner[3] = { w->padded[0] + w->pad, w->padded[1] + w->pad, w->padded[2] + w->pad };
    flip_view_row(inner, view, row);
    to_ycxcz(w, inner);
    for (int c = 0; c < 3; c++)
        for (size_t i = 0; i < w->pad; i++) {
            w->padded[c][i] = inner[c][0];
            inner[c][w->width + i] = inner[c][w->width - 1];
        }
}

static void filter_across(work *w, float *to, int channel, const filter_kernel *kernel)
{
    const int taps = 2 * kernel->radius + 1;
    for (int t = 0; t < taps; t++)
        w->taps[t] = w->padded[channel] + w->pad - (size_t)kernel->radius + (size_t)t;
    filter_rows(to, w->taps, kernel, w->width);
}

static void add_row(work *w, side *one, size_t row)
{
    static const int channel[FLIP_GAUSSIANS] = { 0, 1, 2, 2 };
    const size_t slot = row % w->ring * w->width;
    load_row(w, &one->view, row);
    for (int i = 0; i < FLIP_GAUSSIANS; i++)
        filter_across(w, one->across[i] + slot, channel[i], &w->kernels.gaussian[i]);
    for (int i = 0; i < FLIP_FEATURES; i++)
        filter_across(w, one->across[FLIP_GAUSSIANS + i] + slot, 0, &w->kernels.feature[i]);
}

/* Beyond the first and the last row these go on. */
static void filter_down(work *w, float *to, const float *plane, size_t row,
                        const filter_kernel *kernel)
{
    const int taps = 2 * kernel->radius + 1;
    for (int t = 0; t < taps; t++) {
        const ptrdiff_t wanted = (ptrdiff_t)row + t - kernel->radius;
        const size_t there = wanted < 0                    ? 0
                             : (size_t)wanted >= w->height ? w->height - 1
                                                           : (size_t)wanted;
        w->taps[t] = plane + there % w->ring * w->width;
    }
    filter_rows(to, w->taps, kernel, w->width);
}

static float clamped(float value)
{
    const float least = value > 0.0f ? value : 0.0f;
    return least < 1.0f ? least : 1.0f;
}

/* Of `seen`, whose third channel's narrow part is in `line`. */
static void to_rgb(work *w)
{
    const float narrow = w->kernels.narrow_share;
    float *restrict const first = w->seen[0], *restrict const second = w->seen[1];
    float *restrict const third = w->seen[2];
    const float *restrict const line = w->line;
    for (size_t i = 0; i < w->width; i++) {
        const float y = (first[i] + 16.0f) / 116.0f, x = second[i] / 500.0f + y;
        const float z = y - ((1.0f - narrow) * third[i] + narrow * line[i]) / 200.0f;
        first[i] =
            clamped(w->to_rgb.row[0][0] * x + w->to_rgb.row[0][1] * y + w->to_rgb.row[0][2] * z);
        second[i] =
            clamped(w->to_rgb.row[1][0] * x + w->to_rgb.row[1][1] * y + w->to_rgb.row[1][2] * z);
        third[i] =
            clamped(w->to_rgb.row[2][0] * x + w->to_rgb.row[2][1] * y + w->to_rgb.row[2][2] * z);
    }
}

/* Section 4.1: what is left of the colours when the eye's filters went over them. */
static void see_colours(work *w, side *one, size_t row)
{
    for (int c = 0; c < 3; c++)
        filter_down(w, w->seen[c], one->across[c], row, &w->kernels.gaussian[c]);
    filter_down(w, w->line, one->across[FLIP_BLUE_YELLOW_NARROW], row,
                &w->kernels.gaussian[FLIP_BLUE_YELLOW_NARROW]);
    to_rgb(w);
    lab_of(one->lab, &w->to_xyz, w->seen, w->width);
}

/* Length of a derivative along both axes, of (Y + 16) / 116. */
static void see_feature(work *w, const side *one, float *length, size_t row, flip_feature feature)
{
    const filter_kernel *kernels = w->kernels.feature;
    filter_down(w, length, one->across[FLIP_GAUSSIANS + feature], row, &kernels[FLIP_SMOOTH]);
    filter_down(w, w->line, one->across[FLIP_GAUSSIANS + FLIP_SMOOTH], row, &kernels[feature]);
    for (size_t i = 0; i < w->width; i++)
        length[i] = sqrtf(length[i] * length[i] + w->line[i] * w->line[i]) / 116.0f;
}

/* The colour's difference, to the power of 1 - the features' one. */
static void compare_row(float *map, const work *w)
{
    const side *a = &w->sides[0], *b = &w->sides[1];
    const float most = w->difference_most, steep = p_c * most;
    for (size_t i = 0; i < w->width; i++) {
        const float edge = fabsf(a->edge[i] - b->edge[i]), point = fabsf(a->point[i] - b->point[i]);
        const float feature = sqrtf((edge > point ? edge : point) * 0.70710678f);
        const float apart = powf(distance(a->lab, b->lab, i), q_c);
        const float colour = apart < steep ? apart * (p_t / steep)
                                           : p_t + (apart - steep) / (most - steep) * (1.0f - p_t);
        map[i] = powf(clamped(colour), 1.0f - clamped(feature));
    }
}

static void compare(float *map, work *w)
{
    size_t added = 0;
    for (size_t row = 0; row < w->height; row++) {
        for (; added < w->height && added <= row + w->pad; added++)
            for (int s = 0; s < 2; s++)
                add_row(w, &w->sides[s], added);
        for (int s = 0; s < 2; s++) {
            side *one = &w->sides[s];
            see_colours(w, one, row);
            see_feature(w, one, one->edge, row, FLIP_EDGE);
            see_feature(w, one, one->point, row, FLIP_POINT);
        }
        compare_row(map + row * w->width, w);
    }
}

static fm_status check(const flip_desc *desc, fm_error *err)
{
    const double asked = desc->pixels_per_degree;
    const fm_status status = image_check_pair(desc->image, desc->reference, err);
    if (status != FM_OK)
        return status;
    if (asked != 0 && !(asked >= 1 && asked <= FLIP_PIXELS_PER_DEGREE_MOST))
        return fm_fail(err, FM_INVALID, "%g pixels per degree: from 1 to %d", asked,
                       FLIP_PIXELS_PER_DEGREE_MOST);
    return FM_OK;
}

/* The largest over the exposures, each compared in `one`. */
static void compare_exposures(float *map, float *one, work *w, const double *stops, int count)
{
    const size_t pixels = w->width * w->height;
    for (int i = 0; i < count; i++) {
        for (int s = 0; s < 2; s++)
            w->sides[s].view.gain = (float)exp2(stops[i]);
        compare(i == 0 ? map : one, w);
        for (size_t p = 0; i > 0 && p < pixels; p++)
            map[p] = one[p] > map[p] ? one[p] : map[p];
    }
}

fm_status image_flip(float *map, const flip_desc *desc, fm_error *err)
{
    double stops[FLIP_EXPOSURES_MOST] = { 0 };
    work w = { 0 };
    float *one = NULL;
    fm_status status = check(desc, err);
    if (status != FM_OK)
        return status;
    const int count = desc->is_hdr ? flip_exposures(stops, desc, err) : 1;
    status = count > 0 ? work_create(&w, desc, err) : FM_NO_MEMORY;
    if (status == FM_OK && count > 1) {
        one = malloc(w.width * w.height * sizeof *one);
        if (one == NULL)
            status = fm_fail(err, FM_NO_MEMORY, "FLIP of %zu x %zu px", w.width, w.height);
    }
    w.sides[0].view = (flip_view){ desc->image, desc->is_hdr, 1.0f };
    w.sides[1].view = (flip_view){ desc->reference, desc->is_hdr, 1.0f };
    if (status == FM_OK)
        compare_exposures(map, one, &w, stops, count);
    free(one);
    work_destroy(&w);
    return status;
}
