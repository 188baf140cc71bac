#include "pictures.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "image/colour.h"
#include "image/image_range.h"
#include "image_file.h"
#include "read/picture.h"

enum { SCALE_WIDTH_PX = 256, SCALE_HEIGHT_PX = 12 };

static uint8_t srgb_byte(double linear)
{
    if (!(linear > 0.0))
        return 0;
    return linear >= 1.0 ? 255 : (uint8_t)lround(linear_to_srgb(linear) * 255.0);
}

static size_t pixel_count(const fm_image *image)
{
    return (size_t)image->width_px * image->height_px;
}

static fm_status write_png(const char *path, const fm_image *image, fm_error *err)
{
    uint8_t *bytes = malloc(pixel_count(image) * 3);
    if (bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", path);
    for (size_t i = 0; i < pixel_count(image); i++) {
        double behind = 1.0 - (double)image->rgba[4 * i + 3]; /* how much of the white shows */
        for (size_t c = 0; c < 3; c++)
            bytes[3 * i + c] = srgb_byte((double)image->rgba[4 * i + c] + behind);
    }
    fm_status status = image_file_write_rgb8(path, bytes, image->width_px, image->height_px, err);
    free(bytes);
    return status;
}

/* images/ID KIND.exr and .png. */
static fm_status write_picture(const char *directory, const char *id, const char *kind,
                               const fm_image *image, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], ending[32];
    snprintf(ending, sizeof ending, "%.24s.exr", kind);
    fm_status status = picture_path(path, directory, id, ending, err);
    if (status == FM_OK)
        status =
            image_file_write_rgba32f(path, image->rgba, image->width_px, image->height_px, err);
    snprintf(ending, sizeof ending, "%.24s.png", kind);
    if (status == FM_OK)
        status = picture_path(path, directory, id, ending, err);
    return status != FM_OK ? status : write_png(path, image, err);
}

static fm_status write_heat_png(const char *path, const float *shares, const fm_image *size,
                                fm_error *err)
{
    uint8_t *bytes = malloc(pixel_count(size) * 3);
    if (bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s", path);
    fm_status status = FM_OK;
    for (size_t row = 0; row < size->height_px && status == FM_OK; row++)
        status = image_file_heat(bytes + row * size->width_px * 3, shares + row * size->width_px,
                                 size->width_px, err);
    if (status == FM_OK)
        status = image_file_write_rgb8(path, bytes, size->width_px, size->height_px, err);
    free(bytes);
    return status;
}

/* Where a difference lies between FM_HEAT_LOW and FM_HEAT_HIGH, by decades. */
static float heat_share(double difference)
{
    if (!isfinite(difference))
        return 1.0F;
    if (!(difference > FM_HEAT_LOW))
        return 0.0F;
    double share = log(difference / FM_HEAT_LOW) / log(FM_HEAT_HIGH / FM_HEAT_LOW);
    return (float)fmin(share, 1.0);
}

/* How far two values are apart: 0 where both are the same infinity, infinite where one is no
 * number. */
static double apart_of(float a, float b)
{
    const double apart = a >= b && a <= b ? 0.0 : fabs((double)a - (double)b);
    return isnan(apart) ? INFINITY : apart;
}

/* Fills difference (absolute, by channel) and shares (of the largest channel). */
static void subtract(fm_heat *heat, fm_image *difference, float *shares, const fm_image *a,
                     const fm_image *b)
{
    size_t worst = 0;
    heat->most = 0.0;
    for (size_t i = 0; i < pixel_count(a); i++) {
        double largest = 0.0;
        for (size_t c = 4 * i; c < 4 * i + 4; c++) {
            const double apart = apart_of(a->rgba[c], b->rgba[c]);
            difference->rgba[c] = (float)apart;
            largest = fmax(largest, apart);
        }
        shares[i] = heat_share(largest);
        worst += largest > FM_HEAT_LOW;
        heat->most = fmax(heat->most, largest);
    }
    heat->share = (double)worst / (double)pixel_count(a);
}

/* Two pictures of one case, and the kind of their heat map: ".difference". */
typedef struct picture_pair {
    const fm_image *a, *b;
    const char *a_name, *b_name; /* for people */
    const char *kind;
} picture_pair;

static fm_status write_heat(const char *directory, const char *id, const char *kind,
                            const fm_image *difference, const float *shares, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES], ending[32];
    snprintf(ending, sizeof ending, "%.24s.exr", kind);
    fm_status status = picture_path(path, directory, id, ending, err);
    if (status == FM_OK)
        status = image_file_write_rgba32f(path, difference->rgba, difference->width_px,
                                          difference->height_px, err);
    snprintf(ending, sizeof ending, "%.24s.png", kind);
    if (status == FM_OK)
        status = picture_path(path, directory, id, ending, err);
    return status == FM_OK ? write_heat_png(path, shares, difference, err) : status;
}

static fm_status write_difference(fm_heat *heat, const char *directory, const char *id,
                                  const picture_pair *pair, fm_error *err)
{
    const fm_image *a = pair->a, *b = pair->b;
    fm_image *difference = NULL;
    float *shares = NULL;
    if (a->width_px != b->width_px || a->height_px != b->height_px)
        return fm_fail(err, FM_INVALID, "%s/images/%s: %s is %u x %u, %s is %u x %u", directory, id,
                       pair->a_name, a->width_px, a->height_px, pair->b_name, b->width_px,
                       b->height_px);
    fm_status status = image_create(&difference, a->width_px, a->height_px, err);
    if (status != FM_OK)
        goto out;
    shares = calloc(pixel_count(a), sizeof *shares);
    if (shares == NULL) {
        status = fm_fail(err, FM_NO_MEMORY, "heat map of %s", id);
        goto out;
    }
    subtract(heat, difference, shares, a, b);
    status = write_heat(directory, id, pair->kind, difference, shares, err);
out:
    free(shares);
    image_destroy(difference);
    return status;
}

static float map_share(float value, fm_map_scale scale)
{
    switch (scale) {
    case FM_MAP_DECADES:
        return heat_share((double)value);
    case FM_MAP_SHARE:
        break;
    case FM_MAP_SIMILARITY:
        return isnan(value) ? 0.0F : fminf(fmaxf(1.0F - value, 0.0F), 1.0F);
    }
    return fminf(fmaxf(value, 0.0F), 1.0F);
}

static fm_status map_path(char path[FM_PATH_MAX_BYTES], const char *prefix, const char *name,
                          const char *ending, fm_error *err)
{
    const int length = snprintf(path, FM_PATH_MAX_BYTES, "%s.%s.%s", prefix, name, ending);
    return length < FM_PATH_MAX_BYTES
               ? FM_OK
               : fm_fail(err, FM_INVALID, "%.64s...: too long a path", prefix);
}

fm_status pictures_write_map(const char *prefix, const char *name, const float *map,
                             const fm_image *size, fm_map_scale scale, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    fm_status status = map_path(path, prefix, name, "exr", err);
    float *shares = malloc(pixel_count(size) * sizeof *shares);
    if (shares == NULL)
        return fm_fail(err, FM_NO_MEMORY, "map of %zu pixels", pixel_count(size));
    for (size_t i = 0; i < pixel_count(size); i++)
        shares[i] = map_share(map[i], scale);
    if (status == FM_OK)
        status = image_file_write_grey32f(path, map, size->width_px, size->height_px, err);
    if (status == FM_OK)
        status = map_path(path, prefix, name, "png", err);
    if (status == FM_OK)
        status = write_heat_png(path, shares, size, err);
    free(shares);
    return status;
}

/* Reads a picture that was kept, and writes it. */
static fm_status convert(fm_image **image, const char *directory, const char *id, const char *kind,
                         fm_error *err)
{
    char ending[32];
    snprintf(ending, sizeof ending, "%.20s.rgba32f", kind);
    const fm_status status = picture_read(image, directory, id, ending, err);
    if (status != FM_OK || *image == NULL)
        return status;
    return write_picture(directory, id, kind, *image, err);
}

/* What frames reached, where they drew different images. */
static fm_status write_range(fm_picture_set *set, const char *directory, const char *id,
                             fm_error *err)
{
    fm_image *low = NULL, *high = NULL;
    fm_status status = picture_read(&low, directory, id, FM_RANGE_LOW_ENDING, err);
    if (status == FM_OK)
        status = picture_read(&high, directory, id, FM_RANGE_HIGH_ENDING, err);
    set->has_range = status == FM_OK && low != NULL && high != NULL;
    const picture_pair pair = { high, low, "the range's upper end", "its lower end", ".range" };
    if (set->has_range)
        status = write_difference(&set->range, directory, id, &pair, err);
    image_destroy(low);
    image_destroy(high);
    return status;
}

fm_status pictures_write(fm_picture_set *set, const char *directory, const char *id, fm_error *err)
{
    fm_image *result = NULL, *truth = NULL;
    *set = (fm_picture_set){ .difference = { .most = NAN }, .range = { .most = NAN } };
    fm_status status = convert(&result, directory, id, "", err);
    if (status == FM_OK)
        status = convert(&truth, directory, id, ".truth", err);
    const picture_pair pair = { result, truth, "result", "truth", ".difference" };
    if (status == FM_OK && result != NULL && truth != NULL)
        status = write_difference(&set->difference, directory, id, &pair, err);
    if (status == FM_OK)
        status = write_range(set, directory, id, err);
    set->has_result = result != NULL;
    set->has_truth = truth != NULL;
    image_destroy(result);
    image_destroy(truth);
    return status;
}

fm_status pictures_write_scale(const char *directory, fm_error *err)
{
    char path[FM_PATH_MAX_BYTES];
    float shares[SCALE_WIDTH_PX * SCALE_HEIGHT_PX];
    for (int i = 0; i < SCALE_WIDTH_PX * SCALE_HEIGHT_PX; i++)
        shares[i] = (float)(i % SCALE_WIDTH_PX) / (float)(SCALE_WIDTH_PX - 1);
    fm_image size = { .width_px = SCALE_WIDTH_PX, .height_px = SCALE_HEIGHT_PX };
    const fm_status status = picture_path(path, directory, "heat-scale", ".png", err);
    return status != FM_OK ? status : write_heat_png(path, shares, &size, err);
}
