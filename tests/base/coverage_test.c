/* How often the 95 % interval of a median holds it: draws from launches that were measured. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "launch_noise.h"

enum { DRAWS = 10000 };

/* The share of draws of that many launches whose interval holds the median of all. */
static double coverage(const launch_noise *noise, size_t index, size_t launches, uint64_t seed)
{
    size_t held = 0;
    for (size_t i = 0; i < DRAWS; i++) {
        double values[16];
        for (size_t j = 0; j < launches; j++)
            values[j] = launch_noise_draw(noise, index, &seed);
        const fm_interval interval = stats_interval(values, launches);
        held += interval.low <= noise->median[index] && noise->median[index] <= interval.high;
    }
    return (double)held / DRAWS;
}

/* Within 2 %; of two launches, which often meet the same load and do not see it, within 5 %. */
static void interval_covers_the_median_as_often_as_it_claims(void **state)
{
    static const struct {
        size_t launches;
        double tolerance;
    } rows[] = { { 2, 0.05 }, { 3, 0.02 }, { 5, 0.02 }, { 10, 0.02 } };
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    for (size_t row = 0; row < sizeof rows / sizeof rows[0]; row++) {
        for (size_t i = 0; i < NOISE_CASES; i++) {
            const double held = coverage(&noise, i, rows[row].launches, 1 + i);
            print_message("%zu launches, case %zu: %.1f %%\n", rows[row].launches, i, 100.0 * held);
            assert_true(fabs(held - 0.95) <= rows[row].tolerance);
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(interval_covers_the_median_as_often_as_it_claims),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
