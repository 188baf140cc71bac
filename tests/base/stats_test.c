/* Medians, their intervals by launches, and the random source. */
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

static void interval_of_one_launch_has_no_ends(void **state)
{
    (void)state;
    const double values[] = { 7.0, 8.0, 7.5 };
    const uint32_t groups[] = { 0, 0, 0 };
    const fm_interval i = stats_by_launch(&(fm_samples){ values, groups, 3, 1 });
    assert_true(i.median == 7.5);
    assert_false(interval_is_known(&i));
}

static void interval_of_nothing_is_not_a_number(void **state)
{
    (void)state;
    const fm_interval i = stats_by_launch(&(fm_samples){ NULL, NULL, 0, 0 });
    assert_true(isnan(i.low) && isnan(i.median) && isnan(i.high));
}

/* However many frames a launch has, it counts once. */
static void interval_is_of_the_medians_of_launches(void **state)
{
    (void)state;
    const double values[] = { 4.0, 1.0, 2.0, 2.0, 9.0, 3.0, 3.0, 3.0 };
    const uint32_t groups[] = { 2, 0, 0, 0, 0, 1, 1, 1 }; /* medians 2, 3, 4 */
    const fm_interval i = stats_by_launch(&(fm_samples){ values, groups, 8, 5 });
    assert_true(i.median == 3.0);
    assert_true(fabs(i.low - 2.0 / pow(2.0, 0.815)) < 1e-12);
    assert_true(fabs(i.high - 4.0 * pow(2.0, 0.815)) < 1e-12);
}

static void interval_of_equal_launches_is_exact(void **state)
{
    (void)state;
    double values[] = { 3.0, 3.0, 3.0 };
    const fm_interval i = stats_interval(values, 3);
    assert_true(i.low == 3.0 && i.median == 3.0 && i.high == 3.0);
}

/* Times may be 0 where a clock is coarse: there are no logarithms then. */
static void interval_of_values_with_zero_is_widened_by_their_range(void **state)
{
    (void)state;
    double values[] = { 2.0, 0.0, 1.0 };
    const fm_interval i = stats_interval(values, 3);
    assert_true(fabs(i.low + 1.63) < 1e-12);
    assert_true(fabs(i.high - 3.63) < 1e-12);
}

/* All five lie below the median, or above it, once in sixteen times. */
static void interval_of_five_launches_is_their_range(void **state)
{
    (void)state;
    double values[] = { 5.0, 1.0, 4.0, 2.0, 3.0 };
    const fm_interval i = stats_interval(values, 5);
    assert_true(i.low == 1.0 && i.median == 3.0 && i.high == 5.0);
}

/* Of ten, ranks 2 and 9 hold 97.85 %, ranks 3 and 8 hold 89.06 %: 95 % lies 0.3245 of the way
 * between by probability, which is 0.6577 of the way by value (Hettmansperger and Sheather). */
static void interval_of_many_launches_lies_between_their_ranks(void **state)
{
    (void)state;
    double values[] = { 10, 9, 8, 7, 6, 5, 4, 3, 2, 1 };
    const fm_interval i = stats_interval(values, 10);
    assert_true(i.median == 5.5);
    assert_true(fabs(i.low - 2.6577) < 1e-4);
    assert_true(fabs(i.high - (11.0 - i.low)) < 1e-9);
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
        cmocka_unit_test(interval_of_one_launch_has_no_ends),
        cmocka_unit_test(interval_of_nothing_is_not_a_number),
        cmocka_unit_test(interval_is_of_the_medians_of_launches),
        cmocka_unit_test(interval_of_equal_launches_is_exact),
        cmocka_unit_test(interval_of_values_with_zero_is_widened_by_their_range),
        cmocka_unit_test(interval_of_five_launches_is_their_range),
        cmocka_unit_test(interval_of_many_launches_lies_between_their_ranks),
        cmocka_unit_test(student_falls_towards_the_normal_distribution),
        cmocka_unit_test(random_next_is_splitmix64),
        cmocka_unit_test(random_below_is_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
