#include "image.h"

#include <errno.h>
#include <inttypes.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/file.h"
#include "base/text.h"

static const char magic[] = "fragmark rgba32f ";
enum { HEADER_MAX_BYTES = 64, BYTES_PER_PIXEL = 16 };
static const uint64_t max_pixels = UINT64_C(1) << 28;

#if __BYTE_ORDER__ != __ORDER_LITTLE_ENDIAN__
#error "raw images are little-endian: swap the words of rgba in image_write and image_read"
#endif

static uint64_t pixel_count(const fm_image *image)
{
    return (uint64_t)image->width_px * image->height_px;
}

fm_status image_create(fm_image **image, uint32_t width_px, uint32_t height_px, fm_error *err)
{
    *image = NULL;
    const uint64_t pixels = (uint64_t)width_px * height_px;
    if (pixels == 0 || pixels > max_pixels)
        return fm_fail(err, FM_INVALID, "image: %" PRIu32 " x %" PRIu32 " px: from 1 to %" PRIu64,
                       width_px, height_px, max_pixels);
    fm_image *made = calloc(1, sizeof *made);
    float *rgba = calloc(pixels, BYTES_PER_PIXEL);
    if (made == NULL || rgba == NULL) {
        free(made);
        free(rgba);
        return fm_fail(err, FM_NO_MEMORY, "image: %" PRIu64 " bytes", pixels * BYTES_PER_PIXEL);
    }
    *made = (fm_image){ width_px, height_px, rgba };
    *image = made;
    return FM_OK;
}

void image_destroy(fm_image *image)
{
    if (image == NULL)
        return;
    free(image->rgba);
    free(image);
}

/* A layer rounds the sum and what shows, each by half an ulp of 1 at most, 2^-25: at random they
 * walk to sqrt(2 n) 2^-25. Sequences of 128 to 2048 layers were seen to reach 2^-24 sqrt(n); twice
 * that is allowed, and for few layers what a picture is compared by. */
double image_rounding(uint32_t n)
{
    const double few_layers = 1e-6;
    return fmax(few_layers, 0x1p-23 * sqrt((double)n));
}

fm_status image_check_sizes(const fm_image *image, const fm_image *reference, fm_error *err)
{
    if (image->width_px == reference->width_px && image->height_px == reference->height_px)
        return FM_OK;
    return fm_fail(err, FM_INVALID,
                   "images differ in size: %" PRIu32 " x %" PRIu32 " and %" PRIu32 " x %" PRIu32
                   " px",
                   image->width_px, image->height_px, reference->width_px, reference->height_px);
}

static fm_status check_finite(const fm_image *image, const char *which, fm_error *err)
{
    static const char *const channel[] = { "red", "green", "blue", "alpha" };
    const size_t channels = pixel_count(image) * 4;
    for (size_t i = 0; i < channels; i++)
        if (!isfinite(image->rgba[i]))
            return fm_fail(err, FM_INVALID, "%s, column %zu, row %zu: %s is %g", which,
                           i / 4 % image->width_px, i / 4 / image->width_px, channel[i % 4],
                           (double)image->rgba[i]);
    return FM_OK;
}

fm_status image_check_pair(const fm_image *image, const fm_image *reference, fm_error *err)
{
    fm_status status = image_check_sizes(image, reference, err);
    if (status == FM_OK)
        status = check_finite(image, "the image", err);
    if (status == FM_OK)
        status = check_finite(reference, "the reference", err);
    return status;
}

fm_status image_write(const char *path, const fm_image *image, fm_error *err)
{
    char header[HEADER_MAX_BYTES];
    const size_t header_bytes =
        (size_t)snprintf(header, sizeof header, "%s%" PRIu32 " %" PRIu32 "\n", magic,
                         image->width_px, image->height_px);
    const size_t pixel_bytes = pixel_count(image) * BYTES_PER_PIXEL;
    char *bytes = malloc(header_bytes + pixel_bytes);
    if (bytes == NULL)
        return fm_fail(err, FM_NO_MEMORY, "%s: %zu bytes", path, header_bytes + pixel_bytes);
    memcpy(bytes, header, header_bytes);
    memcpy(bytes + header_bytes, image->rgba, pixel_bytes);
    const fm_status status = text_write_file(path, bytes, header_bytes + pixel_bytes, err);
    free(bytes);
    return status;
}

/* One decimal number that ends at `end`; *text moves behind it. */
static bool take_number(uint32_t *value, char **text, char end)
{
    char *stop = strchr(*text, end);
    if (stop == NULL)
        return false;
    *stop = '\0';
    uint64_t number = 0;
    const bool is_number = text_to_u64(&number, *text) && number <= UINT32_MAX;
    *value = (uint32_t)number;
    *text = stop + 1;
    return is_number;
}

/* Reads and checks the header; the sizes agree with the file's before anything is allocated. */
static fm_status read_header(uint32_t size_px[2], FILE *file, const char *path, fm_error *err)
{
    char line[HEADER_MAX_BYTES];
    const size_t magic_bytes = sizeof magic - 1;
    struct stat info;
    if (fgets(line, sizeof line, file) == NULL || strncmp(line, magic, magic_bytes) != 0)
        return fm_fail(err, FM_INVALID, "%s: header: not a fragmark image", path);
    char *text = line + magic_bytes;
    if (!take_number(&size_px[0], &text, ' ') || !take_number(&size_px[1], &text, '\n'))
        return fm_fail(err, FM_INVALID, "%s: header: bad width or height", path);
    const uint64_t pixels = (uint64_t)size_px[0] * size_px[1];
    const long header_bytes = ftell(file);
    if (header_bytes < 0 || fstat(fileno(file), &info) != 0)
        return fm_fail(err, FM_IO, "%s: %s", path, strerror(errno));
    if (pixels == 0 || pixels > max_pixels ||
        (uint64_t)info.st_size != (uint64_t)header_bytes + pixels * BYTES_PER_PIXEL)
        return fm_fail(err, FM_INVALID,
                       "%s: %" PRIu32 " x %" PRIu32 " px do not fit a file of %jd bytes", path,
                       size_px[0], size_px[1], (intmax_t)info.st_size);
    return FM_OK;
}

fm_status image_read(fm_image **image, const char *path, fm_error *err)
{
    uint32_t size_px[2] = { 0 };
    fm_image *made = NULL;
    *image = NULL;
    FILE *file = NULL;
    fm_status status = file_open_stream(&file, path, err);
    if (status != FM_OK)
        return status;
    status = read_header(size_px, file, path, err);
    if (status != FM_OK)
        goto out;
    status = image_create(&made, size_px[0], size_px[1], err);
    if (made == NULL)
        goto out;
    if (fread(made->rgba, BYTES_PER_PIXEL, pixel_count(made), file) != pixel_count(made)) {
        status = fm_fail(err, FM_IO, "%s: ends before its last pixel", path);
        goto out;
    }
    *image = made;
    made = NULL;
out:
    image_destroy(made);
    fclose(file);
    return status;
}
