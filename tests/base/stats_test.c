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
    const fm_interval i = stats_by_launch(
        &(fm_samples){ .values = values, .group_of = groups, .count = 3, .group_count = 1 });
    assert_true(i.median == 7.5);
    assert_false(interval_is_known(&i));
}

static void interval_of_nothing_is_not_a_number(void **state)
{
    (void)state;
    const fm_interval i = stats_by_launch(&(fm_samples){ 0 });
    assert_true(isnan(i.low) && isnan(i.median) && isnan(i.high));
}

/* However many frames a launch has, it counts once. */
static void interval_is_of_the_medians_of_launches(void **state)
{
    (void)state;
    const double values[] = { 4.0, 1.0, 2.0, 2.0, 9.0, 3.0, 3.0, 3.0 };
    const uint32_t groups[] = { 2, 0, 0, 0, 0, 1, 1, 1 }; /* medians 2, 3, 4 */
    const fm_interval i = stats_by_launch(
        &(fm_samples){ .values = values, .group_of = groups, .count = 8, .group_count = 5 });
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

/* Ten launches reach 99.8 %: at 97.85 % the ends are ranks 2 and 9 themselves. */
static void interval_at_another_coverage_lies_at_other_ranks(void **state)
{
    (void)state;
    double values[] = { 10, 9, 8, 7, 6, 5, 4, 3, 2, 1 };
    const fm_interval i = stats_interval_at(values, 10, 1.0 - 22.0 / 1024.0);
    assert_true(fabs(i.low - 2.0) < 1e-9);
    assert_true(fabs(i.high - 9.0) < 1e-9);
}

static double normal(uint64_t *seed)
{
    const double u = ((double)(random_next(seed) >> 12) + 0.5) * 0x1p-52;
    const double angle = 2.0 * acos(-1.0) * ((double)(random_next(seed) >> 12) * 0x1p-52);
    return sqrt(-2.0 * log(u)) * cos(angle);
}

/* Five launches hold 93.75 % at most by their ranks: beyond them, normal values are asked. */
static void interval_of_few_launches_is_widened_to_the_coverage_of_normal_values(void **state)
{
    (void)state;
    enum { DRAWS = 100000 };
    static const struct {
        size_t count;
        double coverage;
    } rows[] = { { 2, 0.99 }, { 3, 0.98 }, { 4, 0.96 }, { 5, 0.99375 }, { 6, 0.98 }, { 7, 0.999 } };
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        uint64_t seed = 31 + row;
        double held = 0;
        const double coverage = rows[row].coverage;
        double unit[8] = { 0.0 }; /* from -1 to 1: low + 1 is half of the widening, to the left */
        unit[0] = -1.0;
        unit[rows[row].count - 1] = 1.0;
        const fm_interval wide = stats_interval_at(unit, rows[row].count, coverage);
        const double widening = 0.5 * (wide.high - 1.0);
        for (int i = 0; i < DRAWS; i++) {
            double least = INFINITY, greatest = -INFINITY;
            for (size_t j = 0; j < rows[row].count; j++) {
                const double value = normal(&seed);
                least = fmin(least, value);
                greatest = fmax(greatest, value);
            }
            const double more = widening * (greatest - least);
            held += least - more <= 0.0 && greatest + more >= 0.0;
        }
        const double four_errors = 4.0 * sqrt(coverage * (1.0 - coverage) / DRAWS);
        print_message("%zu launches at %g %%: widened by %.3f, held %.3f %%\n", rows[row].count,
                      100.0 * coverage, widening, 100.0 * held / DRAWS);
        assert_true(fabs(held / DRAWS - coverage) < four_errors);
    }
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
        cmocka_unit_test(interval_at_another_coverage_lies_at_other_ranks),
        cmocka_unit_test(interval_of_few_launches_is_widened_to_the_coverage_of_normal_values),
        cmocka_unit_test(student_falls_towards_the_normal_distribution),
        cmocka_unit_test(random_next_is_splitmix64),
        cmocka_unit_test(random_below_is_uniform),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
