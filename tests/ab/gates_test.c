/* Ten thousand gates, drawn from launches that were measured: how often is one wrong, and what does
 * it miss? */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "ab/draws.h"
#include "ab/noise.h"
#include "decide/binomial.h"

enum { METHODS = 3, PAIRS = 80, GATES = 10002, POWER_GATES = 4000 };

/* A/A pairs of a method (layers, n 16, k 8, 214 x 120 pixels, lavapipe): 160 launches on a machine
 * of two processors that other programs used too, at loads of 1 to 7. */
typedef struct pool {
    double values[AB_STATISTIC_COUNT][PAIRS];
    const double *differences[AB_STATISTIC_COUNT];
    ab_noise noise;
    ab_draws draws;
} pool;

static void read_line(pool *of, size_t pair, const char *line)
{
    double base[AB_STATISTIC_COUNT], now[AB_STATISTIC_COUNT];
    const char *at = line;
    for (int i = 0; i < 3; i++) { /* method, pair, which was first */
        at = strchr(at, ',');
        assert_non_null(at);
        at++;
    }
    assert_int_equal(
        sscanf(at, "%lf,%lf,%lf,%lf", &base[AB_TIME], &now[AB_TIME], &base[AB_CPU], &now[AB_CPU]),
        4);
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        of->values[s][pair] = log(now[s] / base[s]);
}

static void read_pairs(pool pools[METHODS])
{
    char path[512], line[256];
    size_t count = 0;
    snprintf(path, sizeof path, "%s/tests/ab/launch_pairs.csv", getenv("FRAGMARK_SOURCE_DIR"));
    FILE *file = fopen(path, "r");
    assert_non_null(file);
    assert_non_null(fgets(line, sizeof line, file)); /* the head */
    while (fgets(line, sizeof line, file) != NULL && count < (size_t)METHODS * PAIRS) {
        read_line(&pools[count / PAIRS], count % PAIRS, line);
        count++;
    }
    fclose(file);
    assert_int_equal(count, METHODS * PAIRS);
}

/* Once for all tests: calibrating takes seconds. */
static int open_pools(void **state)
{
    ab_policy usual;
    pool *pools = calloc(METHODS, sizeof *pools);
    assert_non_null(pools);
    assert_int_equal(ab_policy_make(&usual, NULL, NULL), FM_OK);
    read_pairs(pools);
    for (int i = 0; i < METHODS; i++) {
        pool *of = &pools[i];
        for (int s = 0; s < AB_STATISTIC_COUNT; s++)
            of->differences[s] = of->values[s];
        assert_int_equal(draws_open(&of->draws, of->differences, PAIRS, NULL), FM_OK);
        assert_int_equal(noise_of_pairs(&of->noise, of->differences, PAIRS, &usual, NULL), FM_OK);
    }
    *state = pools;
    return 0;
}

static int close_pools(void **state)
{
    pool *pools = *state;
    for (int i = 0; i < METHODS; i++)
        draws_close(&pools[i].draws);
    free(pools);
    return 0;
}

static void tell(const char *what, uint32_t count, uint32_t of)
{
    fm_interval interval;
    assert_int_equal(binomial_interval(&interval, count, of, 0.95, NULL), FM_OK);
    print_message("%s: %u of %u (%.2f %%, 95 %% interval %.2f to %.2f %%)\n", what, count, of,
                  100.0 * interval.median, 100.0 * interval.low, 100.0 * interval.high);
}

static void set_least(ab_gates_desc *desc, const pool *of)
{
    for (int s = 0; s < AB_STATISTIC_COUNT; s++)
        desc->least[s] = AB_ERRORS_THAT_COUNT * of->noise.statistics[s].standard_error;
}

/* At most 1 % of gates of equal builds end with a confirmed `worse`, calibrated or not. */
static void equal_builds_are_hardly_ever_worse(void **state)
{
    const pool *pools = *state;
    ab_policy policy;
    assert_int_equal(ab_policy_make(&policy, NULL, NULL), FM_OK);
    for (int calibrated = 0; calibrated < 2; calibrated++) {
        uint32_t sums[AB_VERDICT_COUNT] = { 0 };
        uint64_t seed = 20;
        for (int i = 0; i < METHODS; i++) {
            ab_gates_desc desc = { .gates = GATES / METHODS };
            uint32_t verdicts[AB_VERDICT_COUNT];
            if (calibrated)
                set_least(&desc, &pools[i]);
            assert_int_equal(draws_gates(verdicts, &pools[i].draws, &desc, &policy, &seed, NULL),
                             FM_OK);
            for (int v = 0; v < AB_VERDICT_COUNT; v++)
                sums[v] += verdicts[v];
        }
        for (int v = 0; v < AB_VERDICT_COUNT; v++) {
            char what[64];
            snprintf(what, sizeof what, "%s, %s", calibrated ? "calibrated" : "not calibrated",
                     ab_verdict_name((ab_verdict)v));
            tell(what, sums[v], GATES);
        }
        assert_true(sums[AB_WORSE] * 100 <= GATES);
    }
}

/* In how many gates of the pool a build is worse whose one statistic is slower by `effect`. */
static uint32_t count_found(const pool *of, ab_statistic statistic, double effect,
                            const ab_policy *policy)
{
    ab_gates_desc desc = { .gates = POWER_GATES };
    uint32_t verdicts[AB_VERDICT_COUNT];
    uint64_t seed = 21; /* not that of the calibration */
    set_least(&desc, of);
    desc.shift[statistic] = effect;
    assert_int_equal(draws_gates(verdicts, &of->draws, &desc, policy, &seed, NULL), FM_OK);
    return verdicts[AB_WORSE];
}

/* What calibrate calls detectable is found, and confirmed, in at least 90 % of gates. */
static void detectable_effects_are_found(void **state)
{
    const pool *pools = *state;
    ab_policy policy;
    assert_int_equal(ab_policy_make(&policy, NULL, NULL), FM_OK);
    for (int i = 0; i < METHODS; i++)
        for (int s = 0; s < AB_STATISTIC_COUNT; s++) {
            const ab_noise_statistic *noise = &pools[i].noise.statistics[s];
            const uint32_t found =
                count_found(&pools[i], (ab_statistic)s, noise->detectable, &policy);
            char what[128];
            snprintf(
                what, sizeof what,
                "method %d, %s: %.1f %% count, %.1f %% detectable (%.1f %% in 20 pairs), found", i,
                ab_statistic_names[s],
                100.0 * fmax(0.02, expm1(AB_ERRORS_THAT_COUNT * noise->standard_error)),
                100.0 * expm1(noise->detectable), 100.0 * expm1(noise->detectable_first));
            tell(what, found, POWER_GATES);
            assert_true(found * 10 >= 9 * POWER_GATES);
        }
}

/* On quiet launches 5 % more processor time is found in nine of ten gates of 20 pairs; the first
 * method's are, although other programs ran. */
static void five_per_cent_of_processor_time_is_found_in_twenty_pairs(void **state)
{
    static const uint32_t looks[] = { 20, 0 };
    const pool *pools = *state;
    ab_policy policy;
    assert_int_equal(ab_policy_make(&policy, looks, NULL), FM_OK);
    for (int i = 0; i < METHODS; i++) {
        char what[64];
        snprintf(what, sizeof what, "method %d, cpu +5 %%, 20 pairs, found", i);
        const uint32_t found = count_found(&pools[i], AB_CPU, log(1.05), &policy);
        tell(what, found, POWER_GATES);
        assert_true(i > 0 || found * 10 >= 9 * POWER_GATES);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_builds_are_hardly_ever_worse),
        cmocka_unit_test(detectable_effects_are_found),
        cmocka_unit_test(five_per_cent_of_processor_time_is_found_in_twenty_pairs),
    };
    return cmocka_run_group_tests(tests, open_pools, close_pools);
}
