/* Images: files, hash and error metrics. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "base/image.h"

static const double rounding = 1e-6; /* float pixels, double sums */

static fm_image *filled(uint32_t width_px, uint32_t height_px, float value)
{
    fm_image *image = NULL;
    assert_int_equal(image_create(&image, width_px, height_px, NULL), FM_OK);
    for (size_t i = 0; i < (size_t)width_px * height_px * 4; i++)
        image->rgba[i] = value;
    return image;
}

static void temporary_path(char path[64])
{
    strcpy(path, "/tmp/fragmark-image-XXXXXX");
    const int file = mkstemp(path);
    assert_true(file >= 0);
    close(file);
}

static void image_create_rejects_no_pixels_and_too_many(void **state)
{
    (void)state;
    fm_image *image;
    fm_error err;
    assert_int_equal(image_create(&image, 0, 4, &err), FM_INVALID);
    assert_null(image);
    assert_int_equal(image_create(&image, UINT32_MAX, UINT32_MAX, &err), FM_INVALID);
    image_destroy(NULL);
}

static void image_compare_of_equal_images_is_perfect(void **state)
{
    (void)state;
    fm_image *image = filled(20, 15, 0.25f);
    fm_image_error error;
    assert_int_equal(image_compare(&error, image, image, NULL), FM_OK);
    assert_true(error.rmse == 0.0 && error.max_abs == 0.0);
    assert_true(isinf(error.psnr_db) && error.psnr_db > 0.0);
    assert_true(fabs(error.ssim - 1.0) < rounding);
    image_destroy(image);
}

static void image_compare_of_a_constant_difference(void **state)
{
    (void)state;
    fm_image *a = filled(20, 15, 0.5f), *b = filled(20, 15, 0.6f);
    fm_image_error error;
    assert_int_equal(image_compare(&error, a, b, NULL), FM_OK);
    assert_true(fabs(error.rmse - 0.1) < rounding && fabs(error.max_abs - 0.1) < rounding);
    assert_true(fabs(error.psnr_db - 20.0) < 1e-4);
    /* Without variance only the luminance term is left. */
    assert_true(fabs(error.ssim - (0.6 + 1e-4) / (0.25 + 0.36 + 1e-4)) < rounding);
    image_destroy(a);
    image_destroy(b);
}

/* One white pixel on black against black, away from the border: 121 windows see it, and the mean
 * over the windows was worked out from the definition, weights w: u = w, variance w (1 - w). */
static void ssim_of_one_pixel_follows_the_definition(void **state)
{
    (void)state;
    enum { SIDE = 31, CENTRE = 15, RADIUS = 5 };
    fm_image *a = filled(SIDE, SIDE, 0.0f), *b = filled(SIDE, SIDE, 0.0f);
    for (int c = 0; c < 4; c++)
        a->rgba[(CENTRE * SIDE + CENTRE) * 4 + c] = 1.0f;
    double line[2 * RADIUS + 1], sum = 0.0, expected = SIDE * SIDE - 11 * 11;
    for (int i = -RADIUS; i <= RADIUS; i++)
        sum += line[i + RADIUS] = exp(-i * i / 4.5);
    for (int i = 0; i < 121; i++) {
        const double w = line[i / 11] * line[i % 11] / (sum * sum);
        expected += 1e-4 / (w * w + 1e-4) * 9e-4 / (w - w * w + 9e-4);
    }
    double ssim;
    assert_int_equal(image_ssim(&ssim, a, b, NULL), FM_OK);
    assert_true(fabs(ssim - expected / (SIDE * SIDE)) < rounding);
    image_destroy(a);
    image_destroy(b);
}

static void image_compare_rejects_other_sizes(void **state)
{
    (void)state;
    fm_image *a = filled(4, 3, 0.0f), *b = filled(3, 4, 0.0f);
    fm_image_error error;
    fm_error err;
    assert_int_equal(image_compare(&error, a, b, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "4 x 3 and 3 x 4"));
    image_destroy(a);
    image_destroy(b);
}

static void image_compare_of_a_nan_is_infinitely_far(void **state)
{
    (void)state;
    fm_image *a = filled(4, 3, 0.0f);
    fm_image_error error;
    a->rgba[7] = NAN;
    assert_int_equal(image_compare(&error, a, a, NULL), FM_OK);
    assert_true(isinf(error.rmse) && isinf(error.max_abs) && error.ssim == 0.0);
    image_destroy(a);
}

static void image_read_gives_back_what_was_written(void **state)
{
    (void)state;
    char path[64];
    temporary_path(path);
    fm_image *image = filled(5, 3, 0.0f), *back = NULL;
    for (int i = 0; i < 60; i++)
        image->rgba[i] = (float)i / 7.0f;
    assert_int_equal(image_write(path, image, NULL), FM_OK);
    assert_int_equal(image_read(&back, path, NULL), FM_OK);
    assert_int_equal(back->width_px, 5);
    assert_int_equal(back->height_px, 3);
    assert_memory_equal(back->rgba, image->rgba, 60 * sizeof(float));
    image_destroy(image);
    image_destroy(back);
    unlink(path);
}

/* Each starts like an image and is none. */
static void image_read_rejects_damaged_files(void **state)
{
    (void)state;
    static const char *const damaged[] = {
        "",
        "fragmark rgba32f ",
        "fragmark rgba32f 1 1",
        "fragmark rgba32f 1 1\nfifteen bytes..",
        "fragmark rgba32f 1 1\nseventeen bytes...",
        "fragmark rgba32f 4294967295 4294967295\n",
        "fragmark rgba32f 0 0\n",
        "fragmark rgba32f -1 -1\n",
        "fragmark rgba32f 1x1\n",
        "fragmark rgba32f 99999999999999999999 1\n",
        "fragmark rgba8 1 1\n0123456789abcdef",
    };
    char path[64];
    temporary_path(path);
    for (size_t i = 0; i < sizeof damaged / sizeof damaged[0]; i++) {
        fm_image *image;
        fm_error err;
        FILE *file = fopen(path, "wb");
        assert_non_null(file);
        fputs(damaged[i], file);
        fclose(file);
        assert_int_equal(image_read(&image, path, &err), FM_INVALID);
        assert_null(image);
        assert_non_null(strstr(err.message, path));
    }
    unlink(path);
}

static void image_read_of_a_missing_file_is_an_io_error(void **state)
{
    (void)state;
    fm_image *image;
    fm_error err;
    assert_int_equal(image_read(&image, "/nonexistent/image", &err), FM_IO);
    assert_null(image);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(image_create_rejects_no_pixels_and_too_many),
        cmocka_unit_test(image_compare_of_equal_images_is_perfect),
        cmocka_unit_test(image_compare_of_a_constant_difference),
        cmocka_unit_test(ssim_of_one_pixel_follows_the_definition),
        cmocka_unit_test(image_compare_rejects_other_sizes),
        cmocka_unit_test(image_compare_of_a_nan_is_infinitely_far),
        cmocka_unit_test(image_read_gives_back_what_was_written),
        cmocka_unit_test(image_read_rejects_damaged_files),
        cmocka_unit_test(image_read_of_a_missing_file_is_an_io_error),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
