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

#include "base/random.h"
#include "image/image_error.h"
#include "image/image_range.h"

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

static fm_region_error compared(const fm_image *image, const fm_image *reference)
{
    fm_image_error error;
    const image_compare_desc desc = { .image = image, .reference = reference };
    assert_int_equal(image_compare(&error, &desc, NULL), FM_OK);
    return error.region[FM_REGION_VIEWPORT];
}

static void image_compare_of_equal_images_is_perfect(void **state)
{
    (void)state;
    fm_image *image = filled(20, 15, 0.25f);
    const fm_region_error error = compared(image, image);
    assert_true(error.difference.rmse == 0.0 && error.difference.max_abs == 0.0);
    assert_true(isinf(error.difference.psnr_db) && error.difference.psnr_db > 0.0);
    assert_true(fabs(error.ssim - 1.0) < rounding);
    assert_true(error.flip.max == 0.0 && error.flip.weighted_median == 0.0);
    assert_int_equal(error.pixels, 20 * 15);
    image_destroy(image);
}

static void image_compare_of_a_constant_difference(void **state)
{
    (void)state;
    fm_image *a = filled(20, 15, 0.5f), *b = filled(20, 15, 0.6f);
    const fm_region_error error = compared(a, b);
    assert_true(fabs(error.difference.rmse - 0.1) < rounding);
    assert_true(fabs(error.difference.max_abs - 0.1) < rounding);
    assert_true(fabs(error.difference.psnr_db - 20.0) < 1e-4);
    assert_true(fabs(error.absolute.weighted_median - 0.1) < rounding);
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
    enum { SIDE = 41, CENTRE = 20, RADIUS = 5, WINDOWS = (SIDE - 10) * (SIDE - 10) };
    fm_image *a = filled(SIDE, SIDE, 0.0f), *b = filled(SIDE, SIDE, 0.0f);
    for (int c = 0; c < 4; c++)
        a->rgba[(CENTRE * SIDE + CENTRE) * 4 + c] = 1.0f;
    double line[2 * RADIUS + 1], sum = 0.0, expected = WINDOWS - 11 * 11;
    for (int i = -RADIUS; i <= RADIUS; i++)
        sum += line[i + RADIUS] = exp(-i * i / 4.5);
    for (int i = 0; i < 121; i++) {
        const double w = line[i / 11] * line[i % 11] / (sum * sum);
        expected += 1e-4 / (w * w + 1e-4) * 9e-4 / (w - w * w + 9e-4);
    }
    assert_true(fabs(compared(a, b).ssim - expected / WINDOWS) < rounding);
    image_destroy(a);
    image_destroy(b);
}

static float noise(uint64_t *seed)
{
    return (float)random_below(seed, 1u << 24) * 0x1p-24f;
}

/* One channel's window around a pixel, summed as the definition has it. */
static double window_similarity(const fm_image *a, const fm_image *b, int column, int row,
                                int channel)
{
    double weights = 0, x = 0, y = 0, xx = 0, yy = 0, xy = 0;
    for (int j = -5; j <= 5; j++)
        for (int i = -5; i <= 5; i++) {
            const size_t at =
                ((size_t)(row + j) * a->width_px + (size_t)(column + i)) * 4 + (size_t)channel;
            const double w = exp(-(i * i + j * j) / 4.5), u = (double)a->rgba[at],
                         v = (double)b->rgba[at];
            weights += w;
            x += w * u;
            y += w * v;
            xx += w * u * u;
            yy += w * v * v;
            xy += w * u * v;
        }
    x /= weights;
    y /= weights;
    return (2 * x * y + 1e-4) * (2 * (xy / weights - x * y) + 9e-4) /
           ((x * x + y * y + 1e-4) * (xx / weights - x * x + yy / weights - y * y + 9e-4));
}

static void ssim_agrees_with_a_second_implementation(void **state)
{
    (void)state;
    enum { WIDTH = 29, HEIGHT = 17 };
    fm_image *a = filled(WIDTH, HEIGHT, 0), *b = filled(WIDTH, HEIGHT, 0);
    uint64_t seed = 3;
    double sum = 0;
    int windows = 0;
    for (int i = 0; i < WIDTH * HEIGHT * 4; i++) {
        a->rgba[i] = noise(&seed);
        b->rgba[i] = 0.7f * a->rgba[i] + 0.3f * noise(&seed);
    }
    for (int row = 5; row < HEIGHT - 5; row++)
        for (int column = 5; column < WIDTH - 5; column++, windows++)
            for (int channel = 0; channel < 4; channel++)
                sum += 0.25 * window_similarity(a, b, column, row, channel);
    assert_true(fabs(compared(a, b).ssim - sum / windows) < 1e-7);
    image_destroy(a);
    image_destroy(b);
}

static void images_smaller_than_a_window_have_no_ssim(void **state)
{
    (void)state;
    fm_image *image = filled(10, 40, 0.5f);
    assert_true(isnan(compared(image, image).ssim));
    image_destroy(image);
}

/* The right half is covered; one of its pixels is wrong by 0.5, one of the left half by 0.25. */
static void errors_over_covered_pixels_leave_the_others_out(void **state)
{
    (void)state;
    enum { WIDTH = 32, HEIGHT = 12, PIXELS = WIDTH * HEIGHT };
    fm_image *a = filled(WIDTH, HEIGHT, 0.25f), *b = filled(WIDTH, HEIGHT, 0.25f);
    bool covered[PIXELS];
    float absolute[PIXELS], flip[PIXELS];
    fm_image_error error;
    const image_compare_desc desc = {
        .image = a, .reference = b, .covered = covered, .absolute_map = absolute, .flip_map = flip
    };
    for (int i = 0; i < PIXELS; i++) {
        covered[i] = i % WIDTH >= WIDTH / 2;
        a->rgba[4 * i + 3] = b->rgba[4 * i + 3] = 1;
    }
    a->rgba[(6 * WIDTH + 2) * 4] += 0.25f;
    a->rgba[(6 * WIDTH + 24) * 4] += 0.5f;
    assert_int_equal(image_compare(&error, &desc, NULL), FM_OK);
    const fm_region_error *all = &error.region[FM_REGION_VIEWPORT];
    const fm_region_error *half = &error.region[FM_REGION_COVERED];
    assert_true(half->pixels == PIXELS / 2 && all->pixels == PIXELS);
    assert_true(fabs(half->difference.rmse - sqrt(0.25 / (4 * PIXELS / 2))) < rounding);
    assert_true(fabs(all->difference.rmse - sqrt((0.25 + 0.0625) / (4 * PIXELS))) < rounding);
    assert_true(absolute[6 * WIDTH + 2] == 0.25f && absolute[6 * WIDTH + 24] == 0.5f);
    assert_true(half->flip.mean > all->flip.mean && half->flip.max == all->flip.max);
    assert_true(half->flip.max == (double)flip[6 * WIDTH + 24]);
    assert_true(half->ssim < all->ssim);
    memset(covered, 0, sizeof covered);
    assert_int_equal(image_compare(&error, &desc, NULL), FM_OK);
    assert_true(half->pixels == 0 && isnan(half->difference.rmse) && isnan(half->flip.mean));
    image_destroy(a);
    image_destroy(b);
}

/* Ten values: 1 to 9, and 55, which is more than half of the sum of 100. */
static void pooled_numbers_of_ten_values(void **state)
{
    (void)state;
    float values[] = { 5, 1, 55, 3, 2, 9, 7, 4, 8, 6 }, spare[10];
    float infinite[] = { 0, INFINITY, 1 };
    fm_pooled pooled;
    pool_values(&pooled, values, spare, 10);
    assert_true(pooled.mean == 10 && pooled.weighted_median == 55 && pooled.max == 55);
    assert_true(pooled.p95 == 55 && pooled.p99 == 55);
    for (int i = 0; i < 9; i++)
        assert_true(values[i] == (float)(i + 1));
    pool_values(&pooled, values, spare, 9);
    assert_true(pooled.mean == 5 && pooled.weighted_median == 7 && pooled.max == 9);
    pool_values(&pooled, infinite, spare, 3);
    assert_true(isinf(pooled.mean) && isinf(pooled.max));
    pool_values(&pooled, values, spare, 0);
    assert_true(isnan(pooled.mean) && isnan(pooled.max));
}

static void image_compare_rejects_other_sizes(void **state)
{
    (void)state;
    fm_image *a = filled(4, 3, 0.0f), *b = filled(3, 4, 0.0f);
    fm_image_error error;
    fm_difference difference;
    fm_error err;
    const image_compare_desc desc = { .image = a, .reference = b };
    assert_int_equal(image_compare(&error, &desc, &err), FM_INVALID);
    assert_non_null(strstr(err.message, "4 x 3 and 3 x 4"));
    assert_int_equal(image_difference(&difference, a, b, &err), FM_INVALID);
    image_destroy(a);
    image_destroy(b);
}

static void image_compare_of_a_nan_is_infinitely_far(void **state)
{
    (void)state;
    fm_image *a = filled(14, 13, 0.0f);
    a->rgba[7] = NAN;
    const fm_region_error error = compared(a, a);
    assert_true(isinf(error.difference.rmse) && isinf(error.difference.max_abs));
    assert_true(error.ssim == 0.0 && isinf(error.flip.mean));
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

static void a_range_holds_the_least_and_the_most_of_its_images(void **state)
{
    (void)state;
    fm_image_range range = { NULL, NULL }, more = { NULL, NULL };
    fm_image *images[] = { filled(2, 1, 0.5f), filled(2, 1, 0.5f), filled(2, 1, 0.5f) };
    images[0]->rgba[0] = 0.75f;
    images[1]->rgba[5] = 0.25f;
    images[2]->rgba[7] = NAN;
    assert_int_equal(image_range_add(&range, images[0], NULL), FM_OK);
    assert_int_equal(image_range_add(&more, images[1], NULL), FM_OK);
    assert_int_equal(image_range_add(&more, images[2], NULL), FM_OK);
    assert_int_equal(image_range_join(&range, &more, NULL), FM_OK);
    for (int i = 0; i < 8; i++) {
        assert_true(range.low->rgba[i] == (i == 5 ? 0.25f : 0.5f));
        assert_true(range.high->rgba[i] == (i == 0 ? 0.75f : i == 7 ? INFINITY : 0.5f));
    }
    for (int i = 0; i < 3; i++)
        image_destroy(images[i]);
    image_range_free(&range);
    image_range_free(&more);
}

static void a_range_takes_in_images_of_one_size(void **state)
{
    (void)state;
    fm_image_range range = { NULL, NULL };
    fm_image *small = filled(2, 1, 0), *large = filled(2, 2, 0);
    assert_int_equal(image_range_add(&range, small, NULL), FM_OK);
    assert_int_equal(image_range_add(&range, large, NULL), FM_INVALID);
    assert_int_equal(image_range_join(&range, &(fm_image_range){ NULL, NULL }, NULL), FM_OK);
    image_destroy(small);
    image_destroy(large);
    image_range_free(&range);
}

static void a_range_comes_back_from_its_files_and_goes(void **state)
{
    (void)state;
    char prefix[64], path[80];
    fm_image_range range = { NULL, NULL }, read = { NULL, NULL };
    fm_image *low = filled(3, 1, 0.25f), *high = filled(3, 1, 0.5f), *other = filled(1, 1, 0);
    temporary_path(prefix);
    assert_int_equal(image_range_add(&range, low, NULL), FM_OK);
    assert_int_equal(image_range_add(&range, high, NULL), FM_OK);
    assert_int_equal(image_range_write("", &range, NULL), FM_OK);
    assert_int_equal(image_range_read(&read, prefix, NULL), FM_OK);
    assert_null(read.low);
    assert_int_equal(image_range_write(prefix, &range, NULL), FM_OK);
    assert_int_equal(image_range_read(&read, prefix, NULL), FM_OK);
    assert_memory_equal(read.low->rgba, low->rgba, 48);
    assert_memory_equal(read.high->rgba, high->rgba, 48);
    image_range_free(&read);
    snprintf(path, sizeof path, "%s" FM_RANGE_HIGH_ENDING, prefix);
    assert_int_equal(image_write(path, other, NULL), FM_OK);
    assert_int_equal(image_range_read(&read, prefix, NULL), FM_INVALID);
    image_range_free(&read);
    assert_int_equal(image_range_write(prefix, &read, NULL), FM_OK); /* of no image */
    assert_int_not_equal(access(path, F_OK), 0);
    assert_int_equal(image_range_read(&read, prefix, NULL), FM_OK);
    assert_null(read.low);
    assert_int_equal(image_range_write(prefix, &range, NULL), FM_OK);
    assert_int_equal(unlink(path), 0); /* half of it is none */
    assert_int_equal(image_range_read(&read, prefix, NULL), FM_OK);
    assert_null(read.low);
    assert_int_equal(image_range_write(prefix, &read, NULL), FM_OK);
    assert_int_equal(image_range_write("/nowhere/range", &range, NULL), FM_IO);
    unlink(prefix);
    image_destroy(low);
    image_destroy(high);
    image_destroy(other);
    image_range_free(&range);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(image_create_rejects_no_pixels_and_too_many),
        cmocka_unit_test(image_compare_of_equal_images_is_perfect),
        cmocka_unit_test(image_compare_of_a_constant_difference),
        cmocka_unit_test(ssim_of_one_pixel_follows_the_definition),
        cmocka_unit_test(ssim_agrees_with_a_second_implementation),
        cmocka_unit_test(images_smaller_than_a_window_have_no_ssim),
        cmocka_unit_test(errors_over_covered_pixels_leave_the_others_out),
        cmocka_unit_test(pooled_numbers_of_ten_values),
        cmocka_unit_test(image_compare_rejects_other_sizes),
        cmocka_unit_test(image_compare_of_a_nan_is_infinitely_far),
        cmocka_unit_test(image_read_gives_back_what_was_written),
        cmocka_unit_test(image_read_rejects_damaged_files),
        cmocka_unit_test(image_read_of_a_missing_file_is_an_io_error),
        cmocka_unit_test(a_range_holds_the_least_and_the_most_of_its_images),
        cmocka_unit_test(a_range_takes_in_images_of_one_size),
        cmocka_unit_test(a_range_comes_back_from_its_files_and_goes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
