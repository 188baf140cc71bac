#include "image_error.h"

#include <inttypes.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "flip.h"

static size_t pixel_count(const fm_image *image)
{
    return (size_t)image->width_px * image->height_px;
}

float difference_add(difference_sums *sums, const float image[4], const float reference[4])
{
    double largest = 0;
    for (int c = 0; c < 4; c++) {
        const double apart = fabs((double)image[c] - (double)reference[c]);
        const double known = isfinite(apart) ? apart : INFINITY;
        sums->squares += known * known;
        largest = fmax(largest, known);
    }
    sums->most = fmax(sums->most, largest);
    sums->pixels++;
    return (float)largest;
}

fm_difference difference_of(const difference_sums *sums)
{
    if (sums->pixels == 0)
        return (fm_difference){ NAN, NAN, NAN };
    const double rmse = sqrt(sums->squares / (4.0 * (double)sums->pixels));
    return (fm_difference){ .rmse = rmse,
                            .psnr_db = rmse > 0.0 ? -20.0 * log10(rmse) : INFINITY,
                            .max_abs = sums->most };
}

fm_status image_difference(fm_difference *difference, const fm_image *image,
                           const fm_image *reference, fm_error *err)
{
    difference_sums sum = { 0 };
    const fm_status status = image_check_sizes(image, reference, err);
    for (size_t i = 0; status == FM_OK && i < pixel_count(image); i++)
        difference_add(&sum, image->rgba + 4 * i, reference->rgba + 4 * i);
    *difference = difference_of(&sum);
    return status;
}

/* Maps of one comparison, and room to pool them. */
typedef struct maps {
    const image_compare_desc *desc;
    size_t pixels;
    float *absolute, *ssim, *flip; /* [pixels] */
    float *values, *spare;         /* [pixels] */
    bool is_finite;
} maps;

static bool is_in(const maps *m, fm_region region, size_t pixel)
{
    return region == FM_REGION_VIEWPORT || m->desc->covered == NULL || m->desc->covered[pixel];
}

static void pool_map(fm_pooled *pooled, maps *m, const float *map, fm_region region)
{
    size_t count = 0;
    for (size_t i = 0; i < m->pixels; i++)
        if (is_in(m, region, i) && !isnan(map[i]))
            m->values[count++] = map[i];
    pool_values(pooled, m->values, m->spare, count);
}

static double mean_of(const maps *m, const float *map, fm_region region)
{
    double sum = 0;
    size_t count = 0;
    for (size_t i = 0; i < m->pixels; i++)
        if (is_in(m, region, i) && !isnan(map[i])) {
            sum += (double)map[i];
            count++;
        }
    return count > 0 ? sum / (double)count : NAN;
}

static void fill_region(fm_region_error *error, maps *m, fm_region region)
{
    difference_sums sum = { 0 };
    for (size_t i = 0; i < m->pixels; i++)
        if (is_in(m, region, i))
            m->absolute[i] = difference_add(&sum, m->desc->image->rgba + 4 * i,
                                            m->desc->reference->rgba + 4 * i);
    error->pixels = sum.pixels;
    error->difference = difference_of(&sum);
    pool_map(&error->absolute, m, m->absolute, region);
    error->ssim = mean_of(m, m->ssim, region);
    pool_map(&error->flip, m, m->flip, region);
    if (m->is_finite || sum.pixels == 0)
        return;
    error->difference = (fm_difference){ INFINITY, -INFINITY, INFINITY };
    error->ssim = 0;
    error->flip = (fm_pooled){ INFINITY, INFINITY, INFINITY, INFINITY, INFINITY };
}

static fm_status create_maps(maps *m, const image_compare_desc *desc, fm_error *err)
{
    *m = (maps){ .desc = desc, .pixels = pixel_count(desc->image) };
    float **const all[] = { &m->absolute, &m->ssim, &m->flip, &m->values, &m->spare };
    for (size_t i = 0; i < sizeof all / sizeof all[0]; i++) {
        *all[i] = malloc(m->pixels * sizeof(float));
        if (*all[i] == NULL)
            return fm_fail(err, FM_NO_MEMORY, "comparing images of %zu pixels", m->pixels);
    }
    return FM_OK;
}

static fm_status fill_maps(maps *m, fm_error *err)
{
    const image_compare_desc *desc = m->desc;
    const flip_desc flip = { desc->image, desc->reference, desc->pixels_per_degree, desc->is_hdr };
    m->is_finite = image_check_pair(desc->image, desc->reference, NULL) == FM_OK;
    for (size_t i = 0; !m->is_finite && i < m->pixels; i++)
        m->ssim[i] = m->flip[i] = NAN;
    if (!m->is_finite)
        return FM_OK;
    const fm_status status = image_ssim(m->ssim, desc->image, desc->reference, err);
    return status == FM_OK ? image_flip(m->flip, &flip, err) : status;
}

static void give(float *wanted, const float *map, size_t pixels)
{
    if (wanted != NULL)
        memcpy(wanted, map, pixels * sizeof *map);
}

fm_status image_compare(fm_image_error *error, const image_compare_desc *desc, fm_error *err)
{
    maps m = { 0 };
    fm_status status = image_check_sizes(desc->image, desc->reference, err);
    if (status == FM_OK)
        status = create_maps(&m, desc, err);
    if (status == FM_OK)
        status = fill_maps(&m, err);
    if (status == FM_OK) {
        fill_region(&error->region[FM_REGION_COVERED], &m, FM_REGION_COVERED);
        fill_region(&error->region[FM_REGION_VIEWPORT], &m, FM_REGION_VIEWPORT);
        give(desc->absolute_map, m.absolute, m.pixels);
        give(desc->ssim_map, m.ssim, m.pixels);
        give(desc->flip_map, m.flip, m.pixels);
    }
    free(m.absolute);
    free(m.ssim);
    free(m.flip);
    free(m.values);
    free(m.spare);
    return status;
}
