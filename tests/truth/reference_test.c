#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "fragmark/method.h"
#include "truth/reference.h"

/* Half opaque red and green, premultiplied: 102 of 255. */
enum { RED = 102 | 102u << 24, GREEN = 102 << 8 | 102u << 24 };

/* Three pixels: a tie, one fragment at depth 1, nothing. */
static const uint64_t offsets[] = { 0, 2, 3, 3 };
static const fm_fragment fragments[] = { { 0.5f, RED }, { 0.5f, GREEN }, { 1.0f, RED } };
static const fm_truth truth = { .width_px = 3,
                                .height_px = 1,
                                .n = 2,
                                .fragment_count = 3,
                                .nonempty_pixels = 2,
                                .offsets = offsets,
                                .fragments = fragments };

static double distance(const float first[4], const float second[4], uint32_t traits)
{
    float rgba[12] = { 0 };
    fm_image image = { 3, 1, rgba };
    fm_image *const images[] = { &image };
    const reference_images compared = {
        .truth = &truth, .wanted = 2, .traits = traits, .images = images, .count = 1
    };
    double apart = -1;
    for (int c = 0; c < 4; c++) {
        rgba[c] = first[c];
        rgba[4 + c] = second[c];
    }
    assert_int_equal(reference_distance(&apart, &compared, NULL), FM_OK);
    return apart;
}

static const float red_first[] = { 0.4f, 0.24f, 0, 0.64f };
static const float green_first[] = { 0.24f, 0.4f, 0, 0.64f };
static const float red_twice[] = { 0.64f, 0, 0, 0.64f };
static const float red[] = { 0.4f, 0, 0, 0.4f };
static const float nothing[] = { 0, 0, 0, 0 };

static void either_order_of_a_tie_is_right(void **state)
{
    (void)state;
    assert_true(distance(red_first, red, 0) < 1e-6);
    assert_true(distance(green_first, red, 0) < 1e-6);
    assert_true(fabs(distance(red_twice, red, 0) - 0.24) < 1e-6);
    assert_true(distance((float[4]){ NAN, 0, 0, 0 }, red, 0) >= (double)INFINITY);
}

static void a_declared_loss_is_left_out_and_nothing_else(void **state)
{
    (void)state;
    assert_true(fabs(distance(red_first, nothing, 0) - 0.4) < 1e-6);
    assert_true(distance(red_first, nothing, FM_TRAIT_LOSES_DEPTH_ONE) < 1e-6);
    assert_true(fabs(distance(nothing, red, FM_TRAIT_LOSES_DEPTH_ONE) - 0.64) < 1e-6);
    assert_true(distance(nothing, red, FM_TRAIT_LOSES_TIES) < 1e-6);
}

static void the_reference_is_the_nearest_picture(void **state)
{
    (void)state;
    float rgba[12] = { 0.3f, 0.3f, 0, 0.64f, 1, 1, 1, 1 };
    const fm_image image = { 3, 1, rgba };
    fm_reference reference;
    assert_int_equal(reference_create(&reference, &truth, UINT32_MAX, &image, NULL), FM_OK);
    assert_true(fabs((double)reference.wanted->rgba[0] - 0.3) < 1e-6); /* within the interval */
    assert_true(fabs((double)reference.wanted->rgba[4] - 0.4) < 1e-6);
    assert_true(reference.truncation_rmse <= 0);
    reference_free(&reference);
    assert_int_equal(reference_create(&reference, &truth, 1, &image, NULL), FM_OK);
    assert_true(fabs((double)reference.wanted->rgba[3] - 0.4) < 1e-6); /* one of the tied */
    assert_true(fabs((double)reference.all->rgba[3] - 0.64) < 1e-6);
    assert_true(reference.truncation_rmse > 0);
    reference_free(&reference);
}

/* Three stops up: colours, intervals and truncation eightfold, alpha as it was. */
static void exposure_scales_colours_and_not_alpha(void **state)
{
    (void)state;
    float rgba[12] = { 0.3f, 0.3f, 0, 0.64f, 1, 1, 1, 1 };
    fm_image image = { 3, 1, rgba };
    fm_reference plain, exposed;
    assert_int_equal(reference_create(&plain, &truth, 1, &image, NULL), FM_OK);
    assert_int_equal(reference_create(&exposed, &truth, 1, &image, NULL), FM_OK);
    reference_expose(&exposed, &image, 3);
    for (int i = 0; i < 12; i++) {
        const float scale = i % 4 == 3 ? 1.0f : 8.0f;
        assert_true(exposed.wanted->rgba[i] == scale * plain.wanted->rgba[i]);
        assert_true(exposed.all->rgba[i] == scale * plain.all->rgba[i]);
    }
    assert_true(rgba[0] == 8 * 0.3f && rgba[3] == 0.64f);
    /* Of the two tied fragments the second is cut off: 0.24 of green and of alpha, in 12 values. */
    assert_true(fabs(plain.truncation_rmse - 0.24 * sqrt(2.0 / 12)) < 1e-6);
    assert_true(fabs(exposed.truncation_rmse - 0.24 * sqrt(65.0 / 12)) < 1e-6);
    reference_free(&plain);
    reference_free(&exposed);
}

static void tied_pixels_hang_on_how_many_are_wanted(void **state)
{
    (void)state;
    assert_int_equal(truth_tied_pixels(&truth, UINT32_MAX), 1);
    assert_int_equal(truth_tied_pixels(&truth, 1), 1); /* either may be the first */
    assert_int_equal(truth_tied_pixels(&truth, 0), 0);
}

/* Of many frames no picture of truth is made; their errors are those of whole pictures. */
static void the_worst_of_images_has_the_errors_of_whole_pictures(void **state)
{
    (void)state;
    static const double all_stops[] = { 0, 1.5 };
    for (size_t s = 0; s < sizeof all_stops / sizeof all_stops[0]; s++) {
        float rgba[2][12] = { { 0.3f, 0.3f, 0, 0.64f, 1, 0.1f, 1, 1 }, { 0.7f, 0, 0, 0.7f } };
        fm_image images[2] = { { 3, 1, rgba[0] }, { 3, 1, rgba[1] } };
        fm_image *const both[] = { &images[0], &images[1] };
        const reference_images compared = {
            .truth = &truth, .wanted = 1, .images = both, .count = 2
        };
        fm_worst_error worst = { .max_abs = 0.5 }, expected = { .max_abs = 0.5 };
        assert_int_equal(reference_worst(&worst, &compared, all_stops[s], NULL), FM_OK);
        for (int i = 0; i < 2; i++) {
            fm_reference whole;
            fm_difference wanted, all;
            assert_int_equal(reference_create(&whole, &truth, 1, both[i], NULL), FM_OK);
            reference_expose(&whole, both[i], all_stops[s]);
            image_difference(&wanted, both[i], whole.wanted, NULL);
            image_difference(&all, both[i], whole.all, NULL);
            expected.rmse = fmax(expected.rmse, wanted.rmse);
            expected.max_abs = fmax(expected.max_abs, wanted.max_abs);
            expected.total_rmse = fmax(expected.total_rmse, all.rmse);
            reference_free(&whole);
        }
        assert_memory_equal(&worst, &expected, sizeof worst);
        assert_true(worst.rmse > 0.1 && worst.total_rmse > 0.1);
    }
}

static void an_image_that_is_no_number_is_infinitely_far(void **state)
{
    (void)state;
    float rgba[12] = { NAN };
    fm_image image = { 3, 1, rgba };
    fm_image *const images[] = { &image };
    const reference_images compared = {
        .truth = &truth, .wanted = UINT32_MAX, .images = images, .count = 1
    };
    fm_worst_error worst = { 0, 0, 0 };
    assert_int_equal(reference_worst(&worst, &compared, 0, NULL), FM_OK);
    assert_true(isinf(worst.rmse) && isinf(worst.max_abs) && isinf(worst.total_rmse));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(either_order_of_a_tie_is_right),
        cmocka_unit_test(a_declared_loss_is_left_out_and_nothing_else),
        cmocka_unit_test(the_reference_is_the_nearest_picture),
        cmocka_unit_test(exposure_scales_colours_and_not_alpha),
        cmocka_unit_test(the_worst_of_images_has_the_errors_of_whole_pictures),
        cmocka_unit_test(an_image_that_is_no_number_is_infinitely_far),
        cmocka_unit_test(tied_pixels_hang_on_how_many_are_wanted),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
