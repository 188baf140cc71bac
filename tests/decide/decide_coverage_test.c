/* How often 95 % intervals hold what they are of, and how often looks at nothing find something.
 * FRAGMARK_TEST_ALL=1: ten times as many draws. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>

#include "base/launch_noise.h"
#include "decide/binomial.h"
#include "decide/levels.h"
#include "decide/median.h"
#include "decide/signed_rank.h"
#include "decide/walsh.h"

enum { MOST = 40 };

static uint32_t draws(void)
{
    return getenv("FRAGMARK_TEST_ALL") != NULL ? 20000 : 2000;
}

/* Above 0, below 1. */
static double uniform(uint64_t *seed)
{
    return ((double)(random_next(seed) >> 12) + 0.5) * 0x1p-52;
}

/* Where values come from; all have the median 0. */
typedef struct source {
    const char *name;
    double (*draw)(const launch_noise *noise, uint64_t *seed);
    bool is_even; /* the same to both sides of 0 */
} source;

/* Log ratios of pairs: both launches of the same case. */
static double draw_pair(const launch_noise *noise, uint64_t *seed)
{
    const size_t index = random_below(seed, NOISE_CASES);
    return log(launch_noise_draw(noise, index, seed) / launch_noise_draw(noise, index, seed));
}

/* Launches of one case, which have a tail to the slow side. */
static double draw_launch(const launch_noise *noise, uint64_t *seed)
{
    return log(launch_noise_draw(noise, 0, seed) / noise->median[0]);
}

static double draw_normal(const launch_noise *noise, uint64_t *seed)
{
    (void)noise;
    return sqrt(-2.0 * log(uniform(seed))) * cos(2.0 * acos(-1.0) * uniform(seed));
}

static double draw_cauchy(const launch_noise *noise, uint64_t *seed)
{
    (void)noise;
    return tan(acos(-1.0) * (uniform(seed) - 0.5));
}

static double draw_exponential(const launch_noise *noise, uint64_t *seed)
{
    (void)noise;
    return -log(uniform(seed)) - log(2.0);
}

static const source sources[] = {
    { "pairs", draw_pair, true },
    { "launches", draw_launch, false },
    { "normal", draw_normal, true },
    { "cauchy", draw_cauchy, true },
    { "exponential", draw_exponential, false },
};
enum { SOURCES = sizeof sources / sizeof sources[0] };
static const size_t counts[] = { 6, 10, 20, 40 };

/* What an interval is asked of values: whether it holds 0. */
typedef bool (*holder)(const double *values, size_t count);

static bool median_holds(const double *values, size_t count)
{
    fm_median median;
    assert_int_equal(median_bootstrap(&median, values, count, 0.95, NULL), FM_OK);
    return median.interval.low <= 0.0 && 0.0 <= median.interval.high;
}

static bool shift_holds(const double *values, size_t count)
{
    fm_shift shift;
    assert_int_equal(walsh_shift(&shift, values, count, 0.95, NULL), FM_OK);
    return shift.interval.low <= 0.0 && 0.0 <= shift.interval.high;
}

static uint32_t count_held(const launch_noise *noise, const source *from, size_t count,
                           holder holds)
{
    uint64_t seed = 17 + count;
    uint32_t held = 0;
    for (uint32_t i = 0; i < draws(); i++) {
        double values[MOST];
        for (size_t j = 0; j < count; j++)
            values[j] = from->draw(noise, &seed);
        held += holds(values, count);
    }
    return held;
}

/* The whole interval of what was seen lies at or above the least wanted, or holds it. */
static void expect_coverage(uint32_t held, double least, double most, const char *name,
                            size_t count)
{
    fm_interval seen;
    assert_int_equal(binomial_interval(&seen, held, draws(), 0.999, NULL), FM_OK);
    print_message("%-12s n %2zu: %.2f %%\n", name, count, 100.0 * seen.median);
    assert_true(seen.high >= least && seen.low <= most);
}

/* Six values have six places where an end can be; hence 93 %. */
static void median_interval_covers_the_median(void **state)
{
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    for (size_t i = 0; i < SOURCES; i++)
        for (size_t j = 0; j < sizeof counts / sizeof counts[0]; j++)
            expect_coverage(count_held(&noise, &sources[i], counts[j], median_holds), 0.93, 1.0,
                            sources[i].name, counts[j]);
}

static void shift_interval_covers_the_centre_of_even_noise(void **state)
{
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    for (size_t i = 0; i < SOURCES; i++)
        for (size_t j = 0; j < sizeof counts / sizeof counts[0] && sources[i].is_even; j++)
            expect_coverage(count_held(&noise, &sources[i], counts[j], shift_holds), 0.95,
                            counts[j] >= 10 ? 0.965 : 1.0, sources[i].name, counts[j]);
}

/* One gate of A against A: whether any look says that the second is slower. */
static bool looks_find(const launch_noise *noise, const double *levels, const uint32_t *looks,
                       size_t look_count, uint64_t *seed)
{
    double values[MOST];
    uint32_t count = 0;
    for (size_t i = 0; i < look_count; i++) {
        fm_signed_rank test;
        while (count < looks[i])
            values[count++] = draw_pair(noise, seed);
        assert_int_equal(signed_rank_test(&test, values, count, NULL), FM_OK);
        if (test.p_greater <= levels[i])
            return true;
    }
    return false;
}

static void all_looks_together_keep_the_level(void **state)
{
    static const uint32_t looks[] = { 5, 10, 20, 40 };
    double levels[4];
    launch_noise noise;
    uint64_t seed = 23;
    (void)state;
    launch_noise_read(&noise);
    for (size_t first = 0; first <= 2; first += 2) { /* 5, 10, 20, 40, and 20, 40 */
        uint32_t found = 0;
        assert_int_equal(levels_split(levels, looks + first, 4 - first, 0.05, NULL), FM_OK);
        for (uint32_t i = 0; i < draws(); i++)
            found += looks_find(&noise, levels, looks + first, 4 - first, &seed);
        expect_coverage(draws() - found, 0.95, 0.98, "looks", 4 - first);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(median_interval_covers_the_median),
        cmocka_unit_test(shift_interval_covers_the_centre_of_even_noise),
        cmocka_unit_test(all_looks_together_keep_the_level),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
