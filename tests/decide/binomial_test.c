/* Binomial tails against sums of products, and Clopper and Pearson's interval against R's. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "decide/binomial.h"

/* By adding one try after the other. */
static long double slow_at_least(uint32_t k, uint32_t n, long double chance)
{
    static long double row[128];
    long double sum = 0.0L;
    row[0] = 1.0L;
    for (uint32_t try = 1; try <= n; try++) {
        row[try] = 0.0L;
        for (uint32_t i = try; i > 0; i--)
            row[i] = row[i] * (1.0L - chance) + row[i - 1] * chance;
        row[0] *= 1.0L - chance;
    }
    for (uint32_t i = n + 1; i-- > k;)
        sum += row[i];
    return sum;
}

static void tails_equal_the_sum_of_products(void **state)
{
    static const double chances[] = { 1e-6, 0.01, 0.3, 0.5, 0.77, 0.999 };
    (void)state;
    for (uint32_t n = 1; n <= 100; n += 11)
        for (uint32_t k = 0; k <= n; k++)
            for (size_t i = 0; i < sizeof chances / sizeof chances[0]; i++) {
                const double slow = (double)slow_at_least(k, n, chances[i]);
                assert_true(fabs(binomial_at_least(k, n, chances[i]) - slow) <= 1e-12 * slow);
            }
}

/* Exact to all digits shown: 60 digits of decimal arithmetic. */
static void tails_of_many_tries_equal_exact_sums(void **state)
{
    static const struct {
        uint32_t k, n;
        double chance, tail;
    } rows[] = {
        { 101051, 1000000, 0.1, 0.00023553874136951741 },
        { 100500, 1000000, 0.1, 0.048034782205402748 },
        { 99000, 1000000, 0.1, 0.99958038248443049 },
        { 510000, 1000000, 0.5, 2.7721816438496123e-89 },
        { 1, 1000000, 1e-06, 0.63212074276835484 },
        { 2, 1000000, 1e-06, 0.26424111765708469 },
        { 1, 1000000, 1e-12, 9.9999950000066666e-07 },
        { 30, 1000000, 1e-06, 1.4324990305860825e-33 },
        { 999999, 1000000, 0.999999, 0.73575888233233666 },
        { 999990, 1000000, 0.99999, 0.58303975019972187 },
        { 1000000, 1000000, 0.99995, 1.9263403366055454e-22 },
        { 18000, 1000000, 0.012, 0 },
        { 1050, 10000, 0.1, 0.05023783483390331 },
        { 2000, 100000, 0.015, 1.8426616241370758e-35 },
    };
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        const double tail = binomial_at_least(rows[i].k, rows[i].n, rows[i].chance);
        if (!(fabs(tail - rows[i].tail) <= 1e-11 * rows[i].tail))
            fail_msg("%u of %u, %g: %.17g", rows[i].k, rows[i].n, rows[i].chance, tail);
    }
}

static void tails_of_certain_chances_are_certain(void **state)
{
    (void)state;
    assert_true(binomial_at_least(0, 5, 0.0) == 1.0);
    assert_true(binomial_at_least(1, 5, 0.0) == 0.0);
    assert_true(binomial_at_least(5, 5, 1.0) == 1.0);
    assert_true(binomial_at_least(6, 5, 0.5) == 0.0);
}

/* What R's binom.test prints, to the digits that it prints; Mendel's peas are its own example. */
static void intervals_are_those_that_r_prints(void **state)
{
    static const struct {
        uint32_t k, n;
        double low, high;
    } rows[] = {
        { 682, 925, 0.7076683, 0.7654066 },
        { 5, 10, 0.1870860, 0.8129140 },
    };
    fm_interval interval;
    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof rows[0]; i++) {
        assert_int_equal(binomial_interval(&interval, rows[i].k, rows[i].n, 0.95, NULL), FM_OK);
        assert_true(fabs(interval.low - rows[i].low) < 5.1e-8);
        assert_true(fabs(interval.high - rows[i].high) < 5.1e-8);
    }
}

/* None of n, and all of n, have a closed form. */
static void interval_of_none_ends_at_the_root_of_the_tail(void **state)
{
    static const uint32_t counts[] = { 1, 10, 30, 10000, BINOMIAL_TRIES };
    fm_interval none, all;
    (void)state;
    for (int i = 0; i < 5; i++) {
        assert_int_equal(binomial_interval(&none, 0, counts[i], 0.95, NULL), FM_OK);
        assert_int_equal(binomial_interval(&all, counts[i], counts[i], 0.95, NULL), FM_OK);
        const double least = pow(0.025, 1.0 / counts[i]);
        assert_true(none.low == 0.0 && fabs(none.high - (1.0 - least)) < 1e-9);
        assert_true(all.high == 1.0 && fabs(all.low - least) < 1e-9);
    }
}

/* Added up over all outcomes, for chances on a grid: never less than it claims. */
static void interval_covers_at_least_what_it_claims(void **state)
{
    enum { N = 30 };
    fm_interval interval[N + 1];
    (void)state;
    for (uint32_t k = 0; k <= N; k++)
        assert_int_equal(binomial_interval(&interval[k], k, N, 0.95, NULL), FM_OK);
    for (int step = 1; step < 200; step++) {
        const double chance = step / 200.0;
        double held = 0.0;
        for (uint32_t k = 0; k <= N; k++)
            if (interval[k].low <= chance && chance <= interval[k].high)
                held += binomial_at_least(k, N, chance) - binomial_at_least(k + 1, N, chance);
        assert_true(held >= 0.95);
    }
}

static void interval_refuses_what_no_count_can_be(void **state)
{
    fm_interval interval;
    (void)state;
    assert_int_equal(binomial_interval(&interval, 0, 0, 0.95, NULL), FM_INVALID);
    assert_int_equal(binomial_interval(&interval, 3, 2, 0.95, NULL), FM_INVALID);
    assert_int_equal(binomial_interval(&interval, 0, BINOMIAL_TRIES + 1, 0.95, NULL), FM_INVALID);
    assert_int_equal(binomial_interval(&interval, 1, 2, 1.0, NULL), FM_INVALID);
    assert_false(interval_is_known(&interval));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tails_equal_the_sum_of_products),
        cmocka_unit_test(tails_of_many_tries_equal_exact_sums),
        cmocka_unit_test(tails_of_certain_chances_are_certain),
        cmocka_unit_test(intervals_are_those_that_r_prints),
        cmocka_unit_test(interval_of_none_ends_at_the_root_of_the_tail),
        cmocka_unit_test(interval_covers_at_least_what_it_claims),
        cmocka_unit_test(interval_refuses_what_no_count_can_be),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
