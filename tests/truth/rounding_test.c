#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include <cmocka.h>

#include "kit/accumulate_kit.h"
#include "methods/random_kit.h"
#include "truth/truth.h"

enum { LIST_MAX = 2000, LISTS = 3000 };

static const fm_rounding ways[] = {
    { FM_ACCUMULATE_FLOAT16, FM_COMPOSITE_FRONT_TO_BACK },
    { FM_ACCUMULATE_FLOAT16, FM_COMPOSITE_BACK_TO_FRONT },
    { FM_ACCUMULATE_UNORM8, FM_COMPOSITE_FRONT_TO_BACK },
    { FM_ACCUMULATE_UNORM8, FM_COMPOSITE_BACK_TO_FRONT },
};
enum { WAYS = sizeof ways / sizeof ways[0] };

/* All fragments alike: r = g = b = c. */
static void fill(fm_fragment *list, uint32_t count, uint32_t c, uint32_t alpha)
{
    for (uint32_t i = 0; i < count; i++)
        list[i] = (fm_fragment){ .depth = 0.5f, .colour = c * 0x10101u | alpha << 24 };
}

/* What the host's compositor is off double precision, the largest channel. */
static double off(fm_rounding rounding, const fm_fragment *list, uint32_t count)
{
    double exact[4], most = 0;
    float rgba[4];
    composite_pixel(exact, list, count);
    accumulate_pixel(rgba, rounding, list, count);
    for (int c = 0; c < 4; c++)
        most = fmax(most, fabs(exact[c] - (double)rgba[c]));
    return most;
}

static void expect_bound(fm_rounding rounding, const fm_fragment *list, uint32_t count)
{
    const double bound = rounding_bound(rounding, list, count, UINT32_MAX);
    const double is = off(rounding, list, count);
    if (!(is <= bound + 1e-6))
        fail_msg("format %d, composite %d, %u fragments, the first %08X: %.6g off, not %.6g",
                 (int)rounding.accumulate, (int)rounding.composite, count,
                 count > 0 ? list[0].colour : 0, is, bound);
}

static void rounding_stays_below_its_bound_in_random_lists(void **state)
{
    (void)state;
    static fm_fragment list[LIST_MAX];
    uint64_t random = 17;
    for (int i = 0; i < LISTS; i++) {
        const uint32_t count = draw_in(&random, 0, i % 20 == 0 ? LIST_MAX : 40);
        const uint32_t most = draw_in(&random, 1, 255), least = draw_in(&random, 0, most);
        const bool is_premultiplied = draw_in(&random, 0, 7) != 0;
        for (uint32_t at = 0; at < count; at++) {
            const uint32_t alpha = draw_in(&random, least, most);
            const uint32_t top = is_premultiplied ? alpha : 255;
            list[at] =
                (fm_fragment){ .colour = draw_in(&random, 0, top) | draw_in(&random, 0, top) << 8 |
                                         draw_in(&random, 0, top) << 16 | alpha << 24 };
        }
        for (int way = 0; way < WAYS; way++)
            expect_bound(ways[way], list, count);
    }
}

/* Each alpha, with the colours that it may have; few layers and many. */
static void rounding_stays_below_its_bound_in_equal_layers(void **state)
{
    (void)state;
    static const uint32_t counts[] = { 1, 2, 3, 7, 64, 2000 };
    static fm_fragment list[LIST_MAX];
    for (uint32_t alpha = 0; alpha < 256; alpha++)
        for (size_t i = 0; i < sizeof counts / sizeof counts[0]; i++)
            for (uint32_t part = 0; part < 4; part++) {
                fill(list, counts[i], alpha * part / 3, alpha);
                for (int way = 0; way < WAYS; way++)
                    expect_bound(ways[way], list, counts[i]);
            }
}

/* A bound that allows everything would find no wrong image. */
static void rounding_bound_is_a_few_steps_for_few_layers(void **state)
{
    (void)state;
    fm_fragment list[8];
    fill(list, 8, 100, 128);
    for (int way = 0; way < WAYS; way++) {
        const double steps = rounding_bound(ways[way], list, 8, UINT32_MAX) /
                             rounding_ulp(ways[way].accumulate, 0.99);
        if (!(steps < 10 && off(ways[way], list, 8) > 0))
            fail_msg("way %d: %.3g steps", way, steps);
    }
    const fm_rounding plain = { .composite = FM_COMPOSITE_BACK_TO_FRONT };
    assert_true(rounding_bound(plain, list, 8, UINT32_MAX) <= 0);
    assert_true(rounding_bound(ways[0], list, 8, 2) < rounding_bound(ways[0], list, 8, 8));
}

/* 255 - 1/255 of it rounds to less, until half of it is left: then nothing changes any more. */
static void eight_bits_stand_still_half_way(void **state)
{
    (void)state;
    static fm_fragment list[LIST_MAX];
    float rgba[4];
    fill(list, LIST_MAX, 1, 1);
    accumulate_pixel(rgba, ways[2], list, LIST_MAX);
    assert_true(fabsf(rgba[3] * 255 - 128) < 1e-3f);
    accumulate_pixel(rgba, ways[0], list, LIST_MAX);
    assert_true(rgba[3] > 0.99f);
}

static void ulps_are_those_of_the_format(void **state)
{
    (void)state;
    static const struct {
        fm_accumulate format;
        double value, ulp;
    } known[] = {
        { FM_ACCUMULATE_FLOAT16, 1, 0x1p-10 },       { FM_ACCUMULATE_FLOAT16, 0.999, 0x1p-11 },
        { FM_ACCUMULATE_FLOAT16, 0x1p-14, 0x1p-24 }, { FM_ACCUMULATE_FLOAT16, 1e-9, 0x1p-24 },
        { FM_ACCUMULATE_FLOAT16, 0, 0x1p-24 },       { FM_ACCUMULATE_FLOAT32, 1, 0x1p-23 },
        { FM_ACCUMULATE_FLOAT32, 0.3, 0x1p-25 },     { FM_ACCUMULATE_FLOAT32, 0, 0x1p-149 },
        { FM_ACCUMULATE_UNORM8, 0.3, 1 / 255.0 },
    };
    for (size_t i = 0; i < sizeof known / sizeof known[0]; i++)
        if (rounding_ulp(known[i].format, known[i].value) < known[i].ulp ||
            rounding_ulp(known[i].format, known[i].value) > known[i].ulp)
            fail_msg("%g: %g", known[i].value, rounding_ulp(known[i].format, known[i].value));
}

static void ulps_apart_is_the_largest_of_any_channel(void **state)
{
    (void)state;
    const double low[4] = { 0.25, 0.5, 0.5, 0.75 }, high[4] = { 0.5, 0.5, 0.5, 0.75 };
    const float inside[4] = { 0.3f, 0.5f, 0.5f, 0.75f };
    const float off_by_two[4] = { 0.3f, 0.5f + 0x1p-10f, 0.5f, 0.75f + 0x1p-11f };
    const float no_number[4] = { 0.3f, NAN, 0.5f, 0.75f };
    const fm_accumulate half = FM_ACCUMULATE_FLOAT16;
    assert_true(rounding_ulps_apart(half, low, high, inside) <= 0);
    assert_true(fabs(rounding_ulps_apart(half, low, high, off_by_two) - 2) < 1e-9);
    assert_true(isinf(rounding_ulps_apart(half, low, high, no_number)));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rounding_stays_below_its_bound_in_random_lists),
        cmocka_unit_test(rounding_stays_below_its_bound_in_equal_layers),
        cmocka_unit_test(rounding_bound_is_a_few_steps_for_few_layers),
        cmocka_unit_test(eight_bits_stand_still_half_way),
        cmocka_unit_test(ulps_are_those_of_the_format),
        cmocka_unit_test(ulps_apart_is_the_largest_of_any_channel),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
