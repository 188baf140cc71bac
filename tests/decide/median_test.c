/* The bootstrap of the median against all draws written out. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "base/random.h"
#include "decide/median.h"

/* The medians of all n^n draws, sorted; the caller frees them. */
static double *all_medians(size_t *draws, const double *values, size_t n)
{
    *draws = 1;
    for (size_t i = 0; i < n; i++)
        *draws *= n;
    double *medians = calloc(*draws, sizeof *medians);
    assert_non_null(medians);
    for (size_t draw = 0; draw < *draws; draw++) {
        double chosen[8];
        for (size_t i = 0, rest = draw; i < n; i++, rest /= n)
            chosen[i] = values[rest % n];
        medians[draw] = stats_median(chosen, n);
    }
    stats_sort(medians, *draws);
    return medians;
}

static double slow_deviation(const double *values, size_t count)
{
    long double mean = 0.0L, square = 0.0L;
    for (size_t i = 0; i < count; i++)
        mean += values[i];
    mean /= count;
    for (size_t i = 0; i < count; i++)
        square += (values[i] - mean) * (values[i] - mean);
    return (double)sqrtl(square / count);
}

/* The ends are the medians up to which, and from which on, lies at least the tail. */
static void bootstrap_equals_the_enumeration_of_all_draws(void **state)
{
    static const double coverages[] = { 0.95, 0.8, 0.99 };
    uint64_t seed = 7;
    (void)state;
    for (size_t round = 0; round < 21; round++) {
        const size_t n = 1 + round % 7;
        const double tail = 0.5 * (1.0 - coverages[round % 3]);
        double values[8];
        size_t draws;
        fm_median median;
        for (size_t i = 0; i < n; i++)
            values[i] = random_below(&seed, round < 7 ? 4 : 100000) / 10.0; /* first with ties */
        double *medians = all_medians(&draws, values, n);
        const size_t beyond = (size_t)ceil(tail * (double)draws - 1e-9) - 1;
        assert_int_equal(median_bootstrap(&median, values, n, 1.0 - 2.0 * tail, NULL), FM_OK);
        assert_true(fabs(median.standard_error - slow_deviation(medians, draws)) < 1e-9);
        assert_true(median.interval.low == medians[beyond]);
        assert_true(median.interval.high == medians[draws - 1 - beyond]);
        free(medians);
    }
}

/* As many values as a gate has, against 40 000 random draws, whose deviation is off by 0.4 %. */
static void standard_error_is_that_of_random_draws(void **state)
{
    enum { DRAWS = 40000 };
    static double medians[DRAWS];
    static const size_t counts[] = { 39, 40, 200 };
    uint64_t seed = 9;
    (void)state;
    for (int round = 0; round < 3; round++) {
        const size_t n = counts[round];
        double values[200], chosen[200];
        fm_median median;
        for (size_t i = 0; i < n; i++)
            values[i] = log(1.0 + random_below(&seed, 1000));
        for (int draw = 0; draw < DRAWS; draw++) {
            for (size_t i = 0; i < n; i++)
                chosen[i] = values[random_below(&seed, (uint32_t)n)];
            medians[draw] = stats_median(chosen, n);
        }
        assert_int_equal(median_bootstrap(&median, values, n, 0.95, NULL), FM_OK);
        assert_true(fabs(median.standard_error / slow_deviation(medians, DRAWS) - 1.0) < 0.02);
    }
}

/* Neither power overflows, and the chances still add up: a shift of all values shifts all. */
static void bootstrap_takes_a_thousand_values(void **state)
{
    static double values[DECIDE_VALUES];
    fm_median median;
    (void)state;
    for (int i = 0; i < DECIDE_VALUES; i++)
        values[i] = 1e6 + i;
    assert_int_equal(median_bootstrap(&median, values, DECIDE_VALUES, 0.95, NULL), FM_OK);
    assert_true(median.interval.median == 1e6 + 499.5);
    /* sqrt(n) / 2 = 15.8, which is the order statistic's deviation in ranks */
    assert_true(fabs(median.standard_error - 15.8) < 0.1);
    assert_true(fabs(median.interval.low - (1e6 + 499.5 - 1.96 * 15.8)) < 1.0);
    assert_true(fabs(median.interval.high - (1e6 + 499.5 + 1.96 * 15.8)) < 1.0);
}

static void bootstrap_of_equal_values_is_exact(void **state)
{
    const double values[] = { 0.25, 0.25, 0.25, 0.25 };
    fm_median median;
    (void)state;
    assert_int_equal(median_bootstrap(&median, values, 4, 0.95, NULL), FM_OK);
    assert_true(median.standard_error < 1e-12);
    assert_true(median.interval.low == 0.25 && median.interval.high == 0.25);
}

static void bootstrap_refuses_bad_values_and_coverages(void **state)
{
    const double values[] = { 1.0, NAN };
    fm_median median;
    (void)state;
    assert_int_equal(median_bootstrap(&median, values, 2, 0.95, NULL), FM_INVALID);
    assert_int_equal(median_bootstrap(&median, values, 0, 0.95, NULL), FM_INVALID);
    assert_int_equal(median_bootstrap(&median, values, 1, 0.0, NULL), FM_INVALID);
    assert_true(isnan(median.standard_error));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bootstrap_equals_the_enumeration_of_all_draws),
        cmocka_unit_test(standard_error_is_that_of_random_draws),
        cmocka_unit_test(bootstrap_takes_a_thousand_values),
        cmocka_unit_test(bootstrap_of_equal_values_is_exact),
        cmocka_unit_test(bootstrap_refuses_bad_values_and_coverages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
