/* Hodges and Lehmann's estimate against print, and its interval against the test that it inverts.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/random.h"
#include "decide/walsh.h"

/* As in signed_rank_test.c: the estimate and the interval that Hollander and Wolfe print, after
 * less before there, with 96.1 %. */
static void shift_of_nine_patients_is_the_published_one(void **state)
{
    const double depression[] = { 0.952, -0.147, 1.022, 0.430, 0.620, 0.590, 0.490, -0.080, 0.010 };
    fm_shift shift;
    (void)state;
    assert_int_equal(walsh_shift(&shift, depression, 9, 0.95, NULL), FM_OK);
    assert_true(fabs(shift.interval.median - 0.46) < 1e-9);
    assert_true(fabs(shift.interval.low - 0.010) < 1e-9);
    assert_true(fabs(shift.interval.high - 0.786) < 1e-9);
    assert_true(fabs(shift.coverage - (1.0 - 20.0 / 512.0)) < 1e-12);
}

/* p of "the centre is `shift`", by all signs; ranks by counting; no ties. */
static double slow_p(const double *values, int count, double shift)
{
    int sum = 0, above = 0, below = 0, ranks[12];
    for (int i = 0; i < count; i++) {
        ranks[i] = 1;
        for (int j = 0; j < count; j++)
            ranks[i] += fabs(values[j] - shift) < fabs(values[i] - shift);
        sum += values[i] > shift ? ranks[i] : 0;
    }
    for (int signs = 0; signs < 1 << count; signs++) {
        int other = 0;
        for (int i = 0; i < count; i++)
            other += signs >> i & 1 ? ranks[i] : 0;
        above += other >= sum;
        below += other <= sum;
    }
    return fmin(1.0, ldexp(fmin(above, below), 1 - count));
}

/* Just inside of each end no shift is rejected, just outside each is. */
static void interval_holds_the_shifts_that_the_test_does_not_reject(void **state)
{
    uint64_t seed = 3;
    (void)state;
    for (int round = 0; round < 60; round++) {
        const int count = 6 + round % 6;
        const double coverage = round % 2 ? 0.95 : 0.8, near = 1e-7;
        double values[12];
        fm_shift shift;
        for (int i = 0; i < count; i++)
            values[i] = random_below(&seed, 1 << 30) / 1e6;
        assert_int_equal(walsh_shift(&shift, values, (size_t)count, coverage, NULL), FM_OK);
        const fm_interval ends = shift.interval;
        assert_true(slow_p(values, count, ends.low + near) > 1.0 - coverage);
        assert_true(slow_p(values, count, ends.low - near) <= 1.0 - coverage + 1e-12);
        assert_true(slow_p(values, count, ends.high - near) > 1.0 - coverage);
        assert_true(slow_p(values, count, ends.high + near) <= 1.0 - coverage + 1e-12);
        assert_true(ends.low <= ends.median && ends.median <= ends.high);
    }
}

static void five_differences_have_no_interval_of_95_percent(void **state)
{
    const double values[] = { 1.0, 2.0, 4.0, 8.0, 16.0 };
    fm_shift shift;
    (void)state;
    assert_int_equal(walsh_shift(&shift, values, 5, 0.95, NULL), FM_OK);
    assert_true(shift.interval.median == 5.0); /* of 1, 1.5, 2, 2.5, 3, 4, 4.5, 5, 6, 8, ... */
    assert_false(interval_is_known(&shift.interval));
    assert_true(isnan(shift.coverage));
    assert_int_equal(walsh_shift(&shift, values, 5, 0.9, NULL), FM_OK);
    assert_true(shift.interval.low == 1.0 && shift.interval.high == 16.0);
    assert_true(fabs(shift.coverage - 0.9375) < 1e-12);
}

static void shift_refuses_bad_values_and_coverages(void **state)
{
    const double values[] = { 1.0, -INFINITY };
    fm_shift shift;
    (void)state;
    assert_int_equal(walsh_shift(&shift, values, 2, 0.95, NULL), FM_INVALID);
    assert_int_equal(walsh_shift(&shift, values, 0, 0.95, NULL), FM_INVALID);
    assert_int_equal(walsh_shift(&shift, values, 1, 1.0, NULL), FM_INVALID);
    assert_int_equal(walsh_shift(&shift, values, 1, NAN, NULL), FM_INVALID);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(shift_of_nine_patients_is_the_published_one),
        cmocka_unit_test(interval_holds_the_shifts_that_the_test_does_not_reject),
        cmocka_unit_test(five_differences_have_no_interval_of_95_percent),
        cmocka_unit_test(shift_refuses_bad_values_and_coverages),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
