/* The rank-sum test against tables, and against all choices written out; steps in series. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/launch_noise.h"
#include "decide/rank_sum.h"
#include "decide/steps.h"

/* Permeability of ten membranes at term, and of five earlier (Hollander and Wolfe 1973, table 4.1):
 * R's wilcox.test prints W = 35, p = 0.1272. */
static void test_gives_the_published_p_of_fifteen_membranes(void **state)
{
    const double values[] = { 1.15, 0.88, 0.90, 0.74, 1.21, 0.80, 0.83, 1.89,
                              1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46 };
    fm_rank_sum test;
    (void)state;
    assert_int_equal(rank_sum_test(&test, values, 5, 15, NULL), FM_OK);
    assert_true(fabs(test.p_greater - 0.1272) < 5e-5);
    assert_true(fabs(test.shift - 0.305) < 1e-9); /* the estimate that they print */
}

/* The largest U that counts at 5 %, two-sided, of two samples of that size: the textbooks' table.
 */
static void critical_values_are_those_of_the_published_table(void **state)
{
    static const size_t table[][2] = { { 5, 2 }, { 8, 13 }, { 10, 23 }, { 15, 64 }, { 20, 127 } };
    (void)state;
    for (size_t i = 0; i < sizeof table / sizeof table[0]; i++)
        for (size_t beyond = 0; beyond < 2; beyond++) {
            const size_t n = table[i][0], u = table[i][1] + beyond;
            double values[40];
            fm_rank_sum test;
            /* The second sample is above, but for u pairs: its first u / n values lie below all of
             * the first sample, the next below u % n of them. */
            for (size_t k = 0; k < n; k++) {
                values[k] = (double)k;
                values[n + k] = k < u / n    ? -100.0 + (double)k
                                : k == u / n ? (double)(n - u % n) - 0.5
                                             : 100.0 + (double)k;
            }
            assert_int_equal(rank_sum_test(&test, values, n, 2 * n, NULL), FM_OK);
            assert_true((test.p_two_sided <= 0.05) == (beyond == 0));
        }
}

static int slow_rank(const double *values, int count, int i)
{
    int rank = 1;
    for (int j = 0; j < count; j++)
        rank += 2 * (values[j] < values[i]) + (values[j] == values[i]);
    return rank;
}

/* All choices of as many values as the second sample has. */
static void expect_all_choices(const double *values, int first_count, int count)
{
    int sum = 0;
    uint32_t above = 0, below = 0, all = 0;
    fm_rank_sum test;
    for (int i = first_count; i < count; i++)
        sum += slow_rank(values, count, i);
    for (uint32_t chosen = 0; chosen < UINT32_C(1) << count; chosen++) {
        int other = 0;
        if (__builtin_popcount(chosen) != count - first_count)
            continue;
        for (int i = 0; i < count; i++)
            other += chosen >> i & 1 ? slow_rank(values, count, i) : 0;
        all++;
        above += other >= sum;
        below += other <= sum;
    }
    assert_int_equal(rank_sum_test(&test, values, (size_t)first_count, (size_t)count, NULL), FM_OK);
    assert_true(fabs(test.p_greater - (double)above / all) < 1e-12);
    assert_true(fabs(test.p_less - (double)below / all) < 1e-12);
    assert_true(fabs(test.p_two_sided - fmin(1.0, 2.0 * fmin(above, below) / all)) < 1e-12);
}

static void test_equals_the_enumeration_of_all_choices(void **state)
{
    uint64_t seed = 3;
    (void)state;
    for (int round = 0; round < 60; round++) {
        double values[11], p[11];
        const int count = 2 + round % 10;
        for (int i = 0; i < count; i++)
            values[i] = random_below(&seed, round % 3 == 0 ? 1000000 : 4);
        assert_int_equal(rank_sum_splits(p, values, (size_t)count, NULL), FM_OK);
        for (int first = 1; first < count; first++) {
            fm_rank_sum test;
            expect_all_choices(values, first, count);
            assert_int_equal(rank_sum_test(&test, values, (size_t)first, (size_t)count, NULL),
                             FM_OK);
            assert_true(fabs(p[first] - test.p_two_sided) < 1e-12);
        }
    }
}

static void test_refuses_what_it_cannot_rank(void **state)
{
    static double many[RANK_SUM_VALUES + 1];
    const double odd[] = { 1.0, NAN, 2.0 };
    fm_rank_sum test;
    (void)state;
    assert_int_equal(rank_sum_test(&test, odd, 1, 3, NULL), FM_INVALID);
    assert_int_equal(rank_sum_test(&test, many, 0, 3, NULL), FM_INVALID);
    assert_int_equal(rank_sum_test(&test, many, 3, 3, NULL), FM_INVALID);
    assert_int_equal(rank_sum_test(&test, many, 3, RANK_SUM_VALUES + 1, NULL), FM_INVALID);
    assert_int_equal(rank_sum_splits(many, many, 1, NULL), FM_INVALID);
}

/* Nights: logarithms of ratios whose noise is measured, and made a tenth as large: 2 to 3 %. */
static void fill_nights(double *nights, size_t count, const launch_noise *noise, uint64_t *seed)
{
    for (size_t i = 0; i < count; i++)
        nights[i] = 0.1 * log(launch_noise_draw(noise, 0, seed) / noise->median[0]);
}

enum { NIGHTS = 30, MONTHS = 400 };

/* At level 5 % at most 20 of 400 months, and three deviations. */
static void months_without_a_step_seldom_have_one(void **state)
{
    launch_noise noise;
    uint64_t seed = 13;
    size_t found = 0;
    (void)state;
    launch_noise_read(&noise);
    for (int month = 0; month < MONTHS; month++) {
        double nights[NIGHTS];
        fm_step steps[NIGHTS];
        size_t count;
        fill_nights(nights, NIGHTS, &noise, &seed);
        assert_int_equal(
            steps_find(steps, &count, nights, NIGHTS, &(fm_steps_desc){ .level = 0.05 }, NULL),
            FM_OK);
        found += count > 0;
    }
    print_message("%zu of %d months without a step have one\n", found, MONTHS);
    assert_true(found <= 33);
}

/* Up by 12 % at one third, and down by 8 % at two thirds. */
static void two_steps_are_found_where_they_are(void **state)
{
    launch_noise noise;
    uint64_t seed = 29;
    size_t found = 0;
    (void)state;
    launch_noise_read(&noise);
    for (int month = 0; month < MONTHS / 4; month++) {
        double nights[60];
        fm_step steps[60];
        size_t count;
        fill_nights(nights, 60, &noise, &seed);
        for (size_t i = 0; i < 60; i++)
            nights[i] += i < 20 ? 0.0 : i < 40 ? 0.12 : 0.04;
        assert_int_equal(
            steps_find(steps, &count, nights, 60, &(fm_steps_desc){ .level = 0.05 }, NULL), FM_OK);
        found += count == 2 && steps[0].index >= 18 && steps[0].index <= 22 &&
                 steps[1].index >= 38 && steps[1].index <= 42 &&
                 fabs(steps[0].shift - 0.12) < 0.03 && fabs(steps[1].shift + 0.08) < 0.03;
    }
    print_message("%zu of %d series have their two steps\n", found, MONTHS / 4);
    assert_true(found >= 90);
}

static void one_odd_night_is_no_step(void **state)
{
    double nights[NIGHTS];
    fm_step steps[NIGHTS];
    size_t count;
    (void)state;
    for (size_t i = 0; i < NIGHTS; i++)
        nights[i] = i == NIGHTS - 1 ? 9.0 : (double)(i * 7 % 10);
    assert_int_equal(
        steps_find(steps, &count, nights, NIGHTS, &(fm_steps_desc){ .level = 0.05 }, NULL), FM_OK);
    assert_int_equal(count, 0);
}

/* The shortest that can be found: three nights at the end of thirty. */
static void the_last_three_nights_can_be_a_step(void **state)
{
    double nights[NIGHTS];
    fm_step steps[NIGHTS];
    size_t count;
    (void)state;
    for (size_t i = 0; i < NIGHTS; i++)
        nights[i] = (double)(i * 7 % 27) + (i >= 27 ? 100.0 : 0.0);
    assert_int_equal(
        steps_find(steps, &count, nights, NIGHTS, &(fm_steps_desc){ .level = 0.05 }, NULL), FM_OK);
    assert_int_equal(count, 1);
    assert_int_equal(steps[0].index, 27);
    assert_true(fabs(steps[0].p_adjusted - 25.0 / 2030.0) < 1e-9);
}

static void steps_of_short_series_are_none(void **state)
{
    const double few[] = { 1.0, 1.0, 1.0, 9.0, 9.0 };
    fm_step steps[5];
    size_t count = 9;
    (void)state;
    assert_int_equal(steps_find(steps, &count, few, 5, &(fm_steps_desc){ .level = 0.5 }, NULL),
                     FM_OK);
    assert_int_equal(count, 0);
    assert_int_equal(steps_find(steps, &count, few, 0, &(fm_steps_desc){ .level = 0.5 }, NULL),
                     FM_INVALID);
    assert_int_equal(steps_find(steps, &count, few, 5, &(fm_steps_desc){ .level = 0.0 }, NULL),
                     FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gives_the_published_p_of_fifteen_membranes),
        cmocka_unit_test(critical_values_are_those_of_the_published_table),
        cmocka_unit_test(test_equals_the_enumeration_of_all_choices),
        cmocka_unit_test(test_refuses_what_it_cannot_rank),
        cmocka_unit_test(months_without_a_step_seldom_have_one),
        cmocka_unit_test(two_steps_are_found_where_they_are),
        cmocka_unit_test(one_odd_night_is_no_step),
        cmocka_unit_test(the_last_three_nights_can_be_a_step),
        cmocka_unit_test(steps_of_short_series_are_none),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
