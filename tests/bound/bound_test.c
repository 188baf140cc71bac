/* The least time of a case, and what limits it. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "bound/bound.h"

/* 1 GB/s, 10^9 atomics/s. */
static fm_device_limits simple_device(void)
{
    fm_device_limits limits = { .key = { .cores = 1 } };
    for (int i = 0; i < FM_LIMIT_COUNT; i++)
        limits.values[i] = interval_exact(1e9);
    return limits;
}

static void the_bound_is_the_floor_or_the_copying(void **state)
{
    const fm_device_limits limits = simple_device();
    fm_bound_work work = { .fragments = 1000, .kept = 500, .pixels = 100, .floor_ms = 1.0 };
    (void)state;
    /* 8 x 1000 + 16 x 500 + 16 x 100 bytes, at a byte a nanosecond */
    assert_true(bound_bytes(&work) == 17600.0);
    assert_true(bound_ms(&work, &limits) == 1.0);
    work.floor_ms = 0.01;
    assert_true(fabs(bound_ms(&work, &limits) - 0.0176) < 1e-12);
}

static void a_bound_of_unknown_numbers_is_none(void **state)
{
    fm_device_limits limits = simple_device();
    fm_bound_work work = { .fragments = 1000, .kept = 500, .pixels = 100, .floor_ms = NAN };
    (void)state;
    assert_true(isnan(bound_ms(&work, &limits)));
    work.floor_ms = 1.0;
    work.kept = NAN;
    assert_true(isnan(bound_ms(&work, &limits)));
    work.kept = 1.0;
    limits.values[FM_LIMIT_COPY] = (fm_interval){ NAN, NAN, NAN };
    assert_true(isnan(bound_ms(&work, &limits)));
}

static void what_takes_longest_limits(void **state)
{
    fm_device_limits limits = simple_device();
    (void)state;
    /* a million bytes or atomics are a millisecond */
    assert_string_equal(bound_limit_name(bound_limited_by(3.0, 2e6, 1e6, &limits)), "feed");
    assert_string_equal(bound_limit_name(bound_limited_by(1.0, 2e6, 1e6, &limits)), "bytes");
    assert_string_equal(bound_limit_name(bound_limited_by(1.0, 2e6, 3e6, &limits)), "atomics");
    assert_string_equal(bound_limit_name(bound_limited_by(1.0, 1e6, 0.0, &limits)), "feed");
    assert_string_equal(bound_limit_name(bound_limited_by(1.0, NAN, NAN, &limits)), "");
    assert_string_equal(bound_limit_name(bound_limited_by(NAN, 1e6, 0.0, &limits)), "");
    limits.values[FM_LIMIT_ATOMICS_OWN] = (fm_interval){ NAN, NAN, NAN };
    assert_string_equal(bound_limit_name(bound_limited_by(1.0, 2e6, 1.0, &limits)), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_bound_is_the_floor_or_the_copying),
        cmocka_unit_test(a_bound_of_unknown_numbers_is_none),
        cmocka_unit_test(what_takes_longest_limits),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
