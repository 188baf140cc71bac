/* Medians, bootstrap intervals and the random source. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/random.h"
#include "base/stats.h"

static void median_of_nothing_is_not_a_number(void **state)
{
    (void)state;
    assert_true(isnan(stats_median(NULL, 0)));
}

static void median_of_odd_and_even_counts(void **state)
{
    (void)state;
    double odd[] = { 5.0, 1.0, 3.0 }, even[] = { 4.0, 1.0, 3.0, 2.0 };
    assert_true(stats_median(odd, 3) == 3.0);
    assert_true(stats_median(even, 4) == 2.5);
}

static void bootstrap_of_one_sample_is_that_sample(void **state)
{
    (void)state;
    const double value = 7.5;
    const uint32_t group = 0;
    const fm_interval i = stats_bootstrap(&(fm_samples){ &value, &group, 1, 1 }, 1);
    assert_true(i.low == 7.5 && i.median == 7.5 && i.high == 7.5);
}

static void bootstrap_of_nothing_is_not_a_number(void **state)
{
    (void)state;
    const fm_interval i = stats_bootstrap(&(fm_samples){ NULL, NULL, 0, 0 }, 1);
    assert_true(isnan(i.low) && isnan(i.median) && isnan(i.high));
}

static void bootstrap_repeats_for_a_seed(void **state)
{
    (void)state;
    const double values[] = { 1.0, 2.0, 4.0, 8.0, 16.0, 32.0 };
    const uint32_t groups[] = { 0, 1, 2, 0, 1, 2 };
    const fm_samples samples = { values, groups, 6, 3 };
    const fm_interval a = stats_bootstrap(&samples, 42), b = stats_bootstrap(&samples, 42);
    assert_true(a.low == b.low && a.median == b.median && a.high == b.high);
    assert_true(a.low <= a.median && a.median <= a.high && a.low < a.high);
}

/* Launches differ, frames of one do not: resampling frames alone would give a narrow interval. */
static void bootstrap_sees_the_spread_of_launches(void **state)
{
    (void)state;
    double values[90];
    uint32_t by_launch[90], as_one[90];
    for (uint32_t i = 0; i < 90; i++) {
        by_launch[i] = i / 30;
        as_one[i] = 0;
        values[i] = 10.0 * (i / 30) + 0.01 * (i % 30);
    }
    const fm_interval wide = stats_bootstrap(&(fm_samples){ values, by_launch, 90, 3 }, 1);
    const fm_interval narrow = stats_bootstrap(&(fm_samples){ values, as_one, 90, 1 }, 1);
    assert_true(wide.high - wide.low > 15.0);
    assert_true(narrow.high - narrow.low < 15.0);
}

static void bootstrap_leaves_out_empty_groups(void **state)
{
    (void)state;
    const double values[] = { 3.0, 3.0 };
    const uint32_t groups[] = { 4, 1 };
    const fm_interval i = stats_bootstrap(&(fm_samples){ values, groups, 2, 6 }, 9);
    assert_true(i.low == 3.0 && i.median == 3.0 && i.high == 3.0);
}

/* First values of splitmix64 from state 0, as its author published them. */
static void random_next_is_splitmix64(void **state)
{
    (void)state;
    uint64_t s = 0;
    assert_true(random_next(&s) == UINT64_C(0xE220A8397B1DCDAF));
    assert_true(random_next(&s) == UINT64_C(0x6E789E6AA1B965F4));
}

static void random_below_is_uniform(void **state)
{
    (void)state;
    enum { DRAWS = 30000, BOUND = 3, TOLERANCE = 500 /* six standard deviations */ };
    uint32_t counts[BOUND] = { 0 };
    uint64_t s = 5;
    for (int i = 0; i < DRAWS; i++)
        counts[random_below(&s, BOUND)]++;
    for (int i = 0; i < BOUND; i++)
        assert_in_range(counts[i], DRAWS / BOUND - TOLERANCE, DRAWS / BOUND + TOLERANCE);
}

static void student_falls_towards_the_normal_distribution(void **state)
{
    (void)state;
    assert_true(isinf(stats_student(0)));
    assert_float_equal(stats_student(4), 2.776, 1e-9); /* five seeds */
    for (size_t i = 1; i < 40; i++)
        assert_true(stats_student(i) <= stats_student(i - 1));
    assert_true(stats_student(1000) > 1.96);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(median_of_nothing_is_not_a_number),
        cmocka_unit_test(median_of_odd_and_even_counts),
        cmocka_unit_test(bootstrap_of_one_sample_is_that_sample),
        cmocka_unit_test(bootstrap_of_nothing_is_not_a_number),
        cmocka_unit_test(bootstrap_repeats_for_a_seed),
        cmocka_unit_test(bootstrap_sees_the_spread_of_launches),
        cmocka_unit_test(bootstrap_leaves_out_empty_groups),
        cmocka_unit_test(student_falls_towards_the_normal_distribution),
        cmocka_unit_test(random_next_is_splitmix64),
        cmocka_unit_test(random_below_is_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
