/* FLIP: its properties, values that were published, and a second implementation. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/random.h"
#include "flip_slow.h"
#include "image/colour.h"
#include "image/flip.h"

enum { SIDE = 64 };

typedef void painter(float rgb[3], int x, int y);

static fm_image *image_new(uint32_t width_px, uint32_t height_px)
{
    fm_image *image = NULL;
    assert_int_equal(image_create(&image, width_px, height_px, NULL), FM_OK);
    for (size_t i = 0; i < (size_t)width_px * height_px; i++)
        image->rgba[4 * i + 3] = 1;
    return image;
}

/* Of sRGB values, coded from 0 to 255. */
static fm_image *painted(painter *paint)
{
    fm_image *image = image_new(SIDE, SIDE);
    for (int y = 0; y < SIDE; y++)
        for (int x = 0; x < SIDE; x++) {
            float rgb[3];
            paint(rgb, x, y);
            for (int c = 0; c < 3; c++)
                image->rgba[(y * SIDE + x) * 4 + c] = (float)srgb_to_linear((double)rgb[c] / 255.0);
        }
    return image;
}

static void grey(float rgb[3], float value)
{
    rgb[0] = rgb[1] = rgb[2] = value;
}

static void black(float rgb[3], int x, int y)
{
    grey(rgb, 0 * (float)(x + y));
}

static void white(float rgb[3], int x, int y)
{
    grey(rgb, 255 + 0 * (float)(x + y));
}

static void grey_128(float rgb[3], int x, int y)
{
    grey(rgb, 128 + 0 * (float)(x + y));
}

static void grey_129(float rgb[3], int x, int y)
{
    grey(rgb, 129 + 0 * (float)(x + y));
}

static void green(float rgb[3], int x, int y)
{
    black(rgb, x, y);
    rgb[1] = 255;
}

static void blue(float rgb[3], int x, int y)
{
    black(rgb, x, y);
    rgb[2] = 255;
}

static void checker(float rgb[3], int x, int y)
{
    grey(rgb, (x + y) % 2 ? 255 : 0);
}

static void inverse_checker(float rgb[3], int x, int y)
{
    checker(rgb, x + 1, y);
}

static void edge(float rgb[3], int x, int y)
{
    grey(rgb, x >= SIDE / 2 ? 255 : 0 * (float)y);
}

static void edge_moved(float rgb[3], int x, int y)
{
    edge(rgb, x - 1, y);
}

typedef struct seen {
    double mean, least, most;
} seen;

static seen seen_of(const float *map, size_t count)
{
    seen s = { 0, INFINITY, 0 };
    for (size_t i = 0; i < count; i++) {
        s.mean += (double)map[i] / (double)count;
        s.least = fmin(s.least, (double)map[i]);
        s.most = fmax(s.most, (double)map[i]);
    }
    return s;
}

static seen flip(const fm_image *reference, const fm_image *image, double pixels_per_degree)
{
    const size_t pixels = (size_t)image->width_px * image->height_px;
    const flip_desc desc = { .image = image,
                             .reference = reference,
                             .pixels_per_degree = pixels_per_degree };
    float *map = calloc(pixels, sizeof *map);
    fm_error err = { 0 };
    assert_non_null(map);
    if (image_flip(map, &desc, &err) != FM_OK)
        fail_msg("%s", err.message);
    const seen s = seen_of(map, pixels);
    free(map);
    return s;
}

/* The values of the authors' program (1.6, which computes in single precision), but for the step of
 * one grey: no filter changes an even picture, so that it is 0.95 / (0.4 c_max) (L1 - L2)^0.7. */
static void flip_gives_the_values_of_the_authors_program(void **state)
{
    (void)state;
    static const struct {
        painter *reference, *image;
        double pixels_per_degree;
        seen expected;
    } pairs[] = { { black, white, 0, { 0.967388, 0.967388, 0.967388 } },
                  { grey_128, grey_129, 0, { 0.029860, 0.029860, 0.029860 } },
                  { green, blue, 0, { 1, 1, 1 } },
                  { checker, inverse_checker, 0, { 0.004310, 0.001579, 0.398275 } },
                  { edge, edge_moved, 0, { 0.051732, 0, 0.772917 } },
                  { edge, edge_moved, 20, { 0.031332, 0, 0.965638 } } };
    for (size_t i = 0; i < sizeof pairs / sizeof pairs[0]; i++) {
        fm_image *reference = painted(pairs[i].reference), *image = painted(pairs[i].image);
        const seen s = flip(reference, image, pairs[i].pixels_per_degree);
        assert_true(fabs(s.mean - pairs[i].expected.mean) < 2e-5);
        assert_true(fabs(s.least - pairs[i].expected.least) < 2e-4);
        assert_true(fabs(s.most - pairs[i].expected.most) < 2e-4);
        image_destroy(reference);
        image_destroy(image);
    }
}

static float unit(uint64_t *seed)
{
    return (float)random_below(seed, 1u << 24) * 0x1p-24f;
}

/* Patches of noise, translucent in places, and a second image that is near the first. */
static void noise(fm_image *pair[2], uint32_t width_px, uint32_t height_px, float most,
                  uint64_t seed)
{
    for (int s = 0; s < 2; s++)
        pair[s] = image_new(width_px, height_px);
    for (uint32_t y = 0; y < height_px; y++)
        for (uint32_t x = 0; x < width_px; x++)
            for (uint32_t c = 0; c < 4; c++) {
                const size_t i = ((size_t)y * width_px + x) * 4 + c;
                const float value = unit(&seed), other = unit(&seed);
                const bool is_changed = (x / 5 + y / 3) % 3 == 0;
                const float scale = c == 3 ? 1 : most;
                pair[0]->rgba[i] = c == 3 ? 0.5f + 0.5f * value : scale * 0.5f * value;
                pair[1]->rgba[i] = is_changed ? pair[0]->rgba[i] * other : pair[0]->rgba[i];
            }
}

static const uint32_t sizes[][2] = { { 1, 1 }, { 37, 23 }, { 2, 41 }, { 53, 1 }, { 16, 16 } };

static void flip_agrees_with_a_second_implementation(void **state)
{
    (void)state;
    static const double degrees[] = { FLIP_PIXELS_PER_DEGREE, 20, 1 };
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++)
        for (size_t d = 0; d < sizeof degrees / sizeof degrees[0]; d++) {
            fm_image *pair[2];
            noise(pair, sizes[i][0], sizes[i][1], 1, 7 * i + d);
            const size_t pixels = (size_t)sizes[i][0] * sizes[i][1];
            double *slow = calloc(pixels, sizeof *slow), mean = 0, most = 0;
            flip_slow(slow, pair[1], pair[0], degrees[d]);
            for (size_t p = 0; p < pixels; p++) {
                mean += slow[p] / (double)pixels;
                most = fmax(most, slow[p]);
            }
            const seen s = flip(pair[0], pair[1], degrees[d]);
            assert_true(fabs(s.mean - mean) < 1e-6);
            assert_true(fabs(s.most - most) < 1e-5);

            free(slow);
            image_destroy(pair[0]);
            image_destroy(pair[1]);
        }
}

static void flip_of_equal_images_is_zero_and_it_is_symmetric(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        fm_image *pair[2];
        noise(pair, sizes[i][0], sizes[i][1], 1, 100 + i);
        assert_true(flip(pair[0], pair[0], 0).most == 0);
        const seen there = flip(pair[0], pair[1], 0), back = flip(pair[1], pair[0], 0);
        assert_memory_equal(&there, &back, sizeof there);
        assert_true(there.least >= 0 && there.most <= 1);
        image_destroy(pair[0]);
        image_destroy(pair[1]);
    }
}

static void expect_refused(const flip_desc *desc, const char *words)
{
    float map[4 * 3];
    fm_error err = { 0 };
    assert_int_equal(image_flip(map, desc, &err), FM_INVALID);
    if (strstr(err.message, words) == NULL)
        fail_msg("'%s' is not in '%s'", words, err.message);
}

static void flip_refuses_what_is_no_number_with_its_place(void **state)
{
    (void)state;
    fm_image *image = image_new(4, 3), *other = image_new(3, 4);
    const flip_desc own = { .image = image, .reference = image };
    expect_refused(&(flip_desc){ .image = image, .reference = other }, "4 x 3 and 3 x 4");
    expect_refused(&(flip_desc){ .image = image, .reference = image, .pixels_per_degree = 0.5 },
                   "0.5 pixels per degree");
    expect_refused(&(flip_desc){ .image = image, .reference = image, .pixels_per_degree = NAN },
                   "nan");
    image->rgba[(2 * 4 + 1) * 4 + 1] = INFINITY;
    expect_refused(&own, "the image, column 1, row 2: green is inf");
    image->rgba[(1 * 4 + 3) * 4 + 3] = NAN;
    expect_refused(&own, "column 3, row 1: alpha is nan");
    image_destroy(image);
    image_destroy(other);
}

static void hdr_agrees_with_a_second_implementation(void **state)
{
    (void)state;
    for (size_t i = 0; i < sizeof sizes / sizeof sizes[0]; i++) {
        fm_image *pair[2];
        double stops[FLIP_EXPOSURES_MOST];
        const size_t pixels = (size_t)sizes[i][0] * sizes[i][1];
        noise(pair, sizes[i][0], sizes[i][1], 200, 200 + i);
        const flip_desc desc = { .image = pair[1], .reference = pair[0], .is_hdr = true };
        float *map = calloc(pixels, sizeof *map);
        double *slow = calloc(pixels, sizeof *slow), mean = 0;
        const int count = flip_exposures(stops, &desc, NULL);
        assert_int_equal(image_flip(map, &desc, NULL), FM_OK);
        flip_slow_hdr(slow, pair[1], pair[0], FLIP_PIXELS_PER_DEGREE, stops, count);
        for (size_t p = 0; p < pixels; p++)
            mean += slow[p] / (double)pixels;
        assert_true(fabs(seen_of(map, pixels).mean - mean) < 1e-6);
        free(slow);
        free(map);
        image_destroy(pair[0]);
        image_destroy(pair[1]);
    }
}

/* A row of these luminances, opaque. */
static fm_image *row_of(const float *values, uint32_t count)
{
    fm_image *image = image_new(count, 1);
    for (uint32_t i = 0; i < count; i++)
        for (int c = 0; c < 3; c++)
            image->rgba[4 * i + (uint32_t)c] = values[i];
    return image;
}

/* The curve maps x to 0.85 where 0.36 (2.51 - 0.85 * 2.43) x^2 + 0.6 (0.03 - 0.85 * 0.59) x
 * = 0.85 * 0.14: x = 1.8307... */
static void exposures_go_from_the_brightest_to_the_median(void **state)
{
    (void)state;
    double stops[FLIP_EXPOSURES_MOST];
    const double a = 0.36 * (2.51 - 0.85 * 2.43), b = 0.6 * (0.03 - 0.85 * 0.59), c = -0.85 * 0.14;
    const double tone = (-b + sqrt(b * b - 4 * a * c)) / (2 * a);
    fm_image *image = row_of((const float[]){ 64, 2, 1, 4, 0.5f }, 5);
    const int count =
        flip_exposures(stops, &(flip_desc){ .image = image, .reference = image }, NULL);
    assert_int_equal(count, 5); /* from 64 to 2 */
    assert_true(fabs(stops[0] - log2(tone / 64)) < 1e-5);
    assert_true(fabs(stops[4] - log2(tone / 2)) < 1e-5);
    assert_true(fabs(stops[1] - stops[0] - 1.25) < 1e-5);
    image_destroy(image);
}

static void exposures_of_black_pixels_are_bounded(void **state)
{
    (void)state;
    double stops[FLIP_EXPOSURES_MOST];
    fm_image *dim = row_of((const float[]){ 0, 0, 0, 8, 1 }, 5);
    fm_image *steep = row_of((const float[]){ 1e-30f, 1e-30f, 1e-30f, 1e30f }, 4);
    fm_image *dark = row_of((const float[]){ 0, 0, 0, 0 }, 4);
    fm_image *spot = row_of((const float[]){ 0, 0, 0, 4 }, 4);
    float map[5];
    assert_int_equal(flip_exposures(stops, &(flip_desc){ dim, dim, 0, true }, NULL), 3);
    assert_int_equal(flip_exposures(stops, &(flip_desc){ steep, steep, 0, true }, NULL),
                     FLIP_EXPOSURES_MOST - 1);
    assert_int_equal(flip_exposures(stops, &(flip_desc){ dark, dark, 0, true }, NULL), 1);
    assert_true(stops[0] == 0);
    assert_int_equal(image_flip(map, &(flip_desc){ spot, dark, 0, true }, NULL), FM_OK);
    assert_true(map[3] > 0.5f && map[3] <= 1);
    assert_int_equal(image_flip(map, &(flip_desc){ steep, dark, 0, true }, NULL), FM_OK);
    assert_true(map[3] > 0.5f && map[3] <= 1);
    fm_image *beyond = row_of((const float[]){ 3e38f, 3e38f, 3e38f, 3e38f }, 4);
    for (int i = 0; i < 4; i++)
        beyond->rgba[4 * i + 3] = -3e38f; /* finite, but not in front of white */
    assert_int_equal(flip_exposures(stops, &(flip_desc){ beyond, beyond, 0, true }, NULL), 2);
    assert_int_equal(image_flip(map, &(flip_desc){ beyond, beyond, 0, true }, NULL), FM_OK);
    assert_true(map[3] == 0);
    image_destroy(beyond);
    image_destroy(dim);
    image_destroy(steep);
    image_destroy(dark);
    image_destroy(spot);
}

static void cube_roots_are_within_two_steps(void **state)
{
    (void)state;
    for (float x = 1e-30f; x < 2; x *= 1.0371f)
        assert_true(fabs((double)colour_cube_root(x) / cbrt((double)x) - 1) < 2.4e-7);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(flip_gives_the_values_of_the_authors_program),
        cmocka_unit_test(flip_agrees_with_a_second_implementation),
        cmocka_unit_test(flip_of_equal_images_is_zero_and_it_is_symmetric),
        cmocka_unit_test(flip_refuses_what_is_no_number_with_its_place),
        cmocka_unit_test(hdr_agrees_with_a_second_implementation),
        cmocka_unit_test(exposures_go_from_the_brightest_to_the_median),
        cmocka_unit_test(exposures_of_black_pixels_are_bounded),
        cmocka_unit_test(cube_roots_are_within_two_steps),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
