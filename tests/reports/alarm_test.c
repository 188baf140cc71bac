/* When a series of nights is an alarm: by hand, and in months that are made from measured launches.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

#include "base/launch_noise.h"
#include "history/alarm.h"
#include "history/centre.h"

/* Ratios 1.00, 1.01, 1.02, 1.00, ... of one machine, then so many others. */
static fm_alarm judge(const double *last, size_t last_count, size_t before, size_t series)
{
    fm_night nights[64];
    fm_alarm alarm;
    fm_error err;
    for (size_t i = 0; i < before; i++)
        nights[i] = (fm_night){ 1.0 + 0.01 * (double)(i % 3), 7 };
    for (size_t i = 0; i < last_count; i++)
        nights[before + i] = (fm_night){ last[i], 7 };
    const fm_alarm_desc desc = { .series = series };
    assert_int_equal(alarm_judge(&alarm, nights, before + last_count, &desc, &err), FM_OK);
    return alarm;
}

static void three_slow_nights_are_an_alarm_and_two_are_not(void **state)
{
    static const double slow[] = { 1.07, 1.07, 1.08 };
    (void)state;
    assert_int_equal(judge(slow, 1, 20, 1).verdict, FM_ALARM_NONE);
    assert_int_equal(judge(slow, 2, 20, 1).verdict, FM_ALARM_NONE);
    const fm_alarm alarm = judge(slow, 3, 20, 1);
    assert_int_equal(alarm.verdict, FM_ALARM_STEP);
    assert_int_equal(alarm.recent, 3);
    assert_int_equal(alarm.before, 20);
    assert_true(fabs(alarm.factor - 1.07 / 1.01) < 0.005);
    assert_true(fabs(alarm.p - 1.0 / 1771) < 1e-12); /* of the 3 of 23, these alone */
}

static void faster_nights_and_small_steps_are_silent(void **state)
{
    static const double fast[] = { 0.9, 0.9, 0.9 }, near[] = { 1.025, 1.025, 1.025 };
    static const double odd[] = { 1.0, 1.5, 1.01 };
    (void)state;
    assert_int_equal(judge(fast, 3, 20, 1).verdict, FM_ALARM_NONE);
    assert_int_equal(judge(near, 3, 20, 1).verdict, FM_ALARM_NONE); /* a drift may do that */
    assert_int_equal(judge(odd, 3, 20, 1).verdict, FM_ALARM_NONE);
}

/* A night may be wrong 1 time in 600. 5 of 12 is 1 of 792, 5 of 11 1 of 462. */
static void a_young_series_says_how_many_nights_it_needs(void **state)
{
    static const double slow[] = { 1.5, 1.5, 1.5, 1.5, 1.5 };
    (void)state;
    const fm_alarm early = judge(slow, 3, 5, 1);
    assert_int_equal(early.verdict, FM_ALARM_EARLY);
    assert_int_equal(early.needed, 12);
    assert_int_equal(early.before, 7);
    assert_int_equal(judge(slow, 5, 6, 1).verdict, FM_ALARM_EARLY);
    assert_int_equal(judge(slow, 5, 7, 1).verdict, FM_ALARM_STEP);
}

static void a_hundred_series_need_more_nights_each(void **state)
{
    static const double slow[] = { 1.5, 1.5, 1.5, 1.5, 1.5 };
    (void)state;
    assert_int_equal(judge(slow, 3, 30, 100).verdict, FM_ALARM_NONE);
    const fm_alarm alarm = judge(slow, 5, 30, 100);
    assert_int_equal(alarm.verdict, FM_ALARM_STEP);
    assert_int_equal(alarm.recent, 5);
}

static void nights_of_other_machines_are_left_out(void **state)
{
    fm_night nights[80];
    fm_alarm alarm;
    fm_error err;
    (void)state;
    for (size_t i = 0; i < 80; i++) /* every second night on one that is slower by half */
        nights[i] = (fm_night){ (i % 2 == 0 ? 1.0 : 1.5) + 0.01 * (double)(i % 3), i % 2 };
    for (size_t count = 60; count <= 80; count++) {
        assert_int_equal(alarm_judge(&alarm, nights, count, &(fm_alarm_desc){ 0 }, &err), FM_OK);
        assert_int_equal(alarm.verdict, FM_ALARM_NONE);
    }
    nights[75].ratio = nights[77].ratio = nights[79].ratio = 1.7;
    assert_int_equal(alarm_judge(&alarm, nights, 80, &(fm_alarm_desc){ 0 }, &err), FM_OK);
    assert_int_equal(alarm.verdict, FM_ALARM_STEP);
    nights[79].ratio = NAN;
    assert_int_equal(alarm_judge(&alarm, nights, 80, &(fm_alarm_desc){ 0 }, &err), FM_OK);
    assert_int_equal(alarm.verdict, FM_ALARM_UNMEASURED);
}

static void bad_series_are_refused(void **state)
{
    static const double bad[] = { 0.0, -1.0, INFINITY };
    static const fm_alarm_desc wrong[] = { { .level = 1.0 }, { .least = 0.5 }, { .drift = 0.9 } };
    fm_alarm alarm;
    fm_error err;
    (void)state;
    assert_int_equal(alarm_judge(&alarm, NULL, 0, &(fm_alarm_desc){ 0 }, &err), FM_INVALID);
    for (size_t i = 0; i < 3; i++) {
        const fm_night night = { bad[i], 0 }, good = { 1.0, 0 };
        assert_int_equal(alarm_judge(&alarm, &night, 1, &(fm_alarm_desc){ 0 }, &err), FM_INVALID);
        assert_int_equal(alarm_judge(&alarm, &good, 1, &wrong[i], &err), FM_INVALID);
    }
}

/* Of 2, 4 and 8 the middle one; of few launches nothing else is left. */
static void a_centre_leaves_out_the_ends(void **state)
{
    double three[] = { 8.0, 2.0, 4.0 }, two[] = { 2.0, 8.0 };
    double twelve[] = { 1, 1, 2, 2, 2, 2, 2, 2, 2, 2, 1000, 1000 };
    (void)state;
    assert_true(fabs(centre_of(three, 3).ratio - 4.0) < 1e-12);
    assert_true(fabs(centre_of(two, 2).ratio - 4.0) < 1e-12);
    assert_true(fabs(centre_of(twelve, 12).ratio - 2.0) < 1e-12);
    assert_true(isnan(centre_of(two, 0).ratio));
    assert_true(isnan(centre_of(two, 1).standard_error));
    assert_true(isnan(centre_of(three, 3).standard_error));
    assert_true(centre_of(two, 2).standard_error > 0);
}

/* The standard error is how far the centre really moves: within a tenth, of 40 launches. */
static void the_standard_error_is_that_of_the_centre(void **state)
{
    enum { DRAWS = 2000, LAUNCHES = 40 };
    launch_noise noise;
    uint64_t seed = 3;
    double sum = 0.0, squares = 0.0, told = 0.0;
    (void)state;
    launch_noise_read(&noise);
    for (size_t i = 0; i < DRAWS; i++) {
        double values[LAUNCHES];
        for (size_t j = 0; j < LAUNCHES; j++)
            values[j] = launch_noise_draw(&noise, 0, &seed);
        const fm_centre centre = centre_of(values, LAUNCHES);
        sum += log(centre.ratio);
        squares += log(centre.ratio) * log(centre.ratio);
        told += centre.standard_error;
    }
    const double moved = sqrt(squares / DRAWS - sum * sum / DRAWS / DRAWS);
    print_message("standard error: told %.4f, moved %.4f\n", told / DRAWS, moved);
    assert_true(fabs(told / DRAWS / moved - 1.0) < 0.1);
}

/* Months that are made up. Each night both machines measure: a steady one, whose launches are those
 * that were measured, and one that is three times as noisy and slower at this case. What is
 * measured is drawn anew; a drift of 1 % a month goes up or down. */
enum { NIGHTS = 60, MONTH = 30, MACHINES = 2 };

typedef struct months {
    const launch_noise *noise;
    size_t method, over; /* whose launches are divided by whose, of the same round */
    size_t launches;     /* a night */
    uint64_t seed;
} months;

static double draw_night(months *from, size_t machine)
{
    double ratios[512];
    for (size_t i = 0; i < from->launches; i++) {
        const uint32_t launch = random_below(&from->seed, NOISE_LAUNCHES);
        const double ratio =
            from->noise->frame_ms[from->method][launch] / from->noise->frame_ms[from->over][launch];
        ratios[i] = machine == 0 ? ratio : 1.2 * pow(ratio, 3.0);
    }
    return centre_of(ratios, from->launches).ratio;
}

static void draw_month(fm_night nights[MACHINES][NIGHTS], months *from)
{
    const double drift = random_below(&from->seed, 2) == 0 ? 0.01 : -0.01;
    for (size_t machine = 0; machine < MACHINES; machine++)
        for (size_t i = 0; i < NIGHTS; i++)
            nights[machine][i] =
                (fm_night){ draw_night(from, machine) * exp(drift * (double)i / MONTH), machine };
}

/* Whether there is an alarm in these nights, on either machine. */
static bool rings(fm_night nights[MACHINES][NIGHTS], size_t first, size_t end)
{
    const fm_alarm_desc desc = { .series = MACHINES };
    fm_alarm alarm;
    fm_error err;
    bool is_alarm = false;
    for (size_t machine = 0; machine < MACHINES; machine++)
        for (size_t i = first; i < end; i++) {
            assert_int_equal(alarm_judge(&alarm, nights[machine], i + 1, &desc, &err), FM_OK);
            is_alarm |= alarm.verdict == FM_ALARM_STEP;
        }
    return is_alarm;
}

/* The month that counts follows one of history. */
static void count_alarms(size_t *found, size_t *wrong, months *from, size_t count)
{
    static fm_night nights[MACHINES][NIGHTS];
    *found = *wrong = 0;
    for (size_t month = 0; month < count; month++) {
        draw_month(nights, from);
        *wrong += rings(nights, NIGHTS - MONTH, NIGHTS);
        const size_t step = NIGHTS - MONTH + random_below(&from->seed, MONTH - 2);
        for (size_t machine = 0; machine < MACHINES; machine++)
            for (size_t i = step; i < NIGHTS; i++)
                nights[machine][i].ratio *= 1.06;
        *found += rings(nights, step, step + 3);
    }
}

/* The launches that were measured scatter by 18 to 21 % even in ratios, on two processors that
 * others used. So it takes 220 of them a night to see 6 % in three nights whichever pair it is:
 * found 98, 92 and 100 %, without a step 2 to 3 % of 1000 months. 160 find 94, 81 and 100 %, 60
 * find 45, 28 and 72 %. With the median of a night's launches 400 are not enough. */
enum { LAUNCHES = 220 };

static void a_step_of_six_percent_is_found_in_three_nights(void **state)
{
    static const size_t pairs[][2] = { { 2, 0 }, { 1, 0 }, { 2, 1 } };
    const size_t count = getenv("FRAGMARK_TEST_ALL") != NULL ? 1000 : 60;
    launch_noise noise;
    (void)state;
    launch_noise_read(&noise);
    for (size_t i = 0; i < 3; i++) {
        size_t found, wrong;
        months from = { &noise, pairs[i][0], pairs[i][1], LAUNCHES, 11 };
        count_alarms(&found, &wrong, &from, count);
        print_message("%zu months, %zu launches a night: found %.1f %%, without a step %.1f %%\n",
                      count, from.launches, 100.0 * (double)found / (double)count,
                      100.0 * (double)wrong / (double)count);
        assert_true((double)found >= 0.9 * (double)count);
        assert_true((double)wrong <= 0.05 * (double)count);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(three_slow_nights_are_an_alarm_and_two_are_not),
        cmocka_unit_test(faster_nights_and_small_steps_are_silent),
        cmocka_unit_test(a_young_series_says_how_many_nights_it_needs),
        cmocka_unit_test(a_hundred_series_need_more_nights_each),
        cmocka_unit_test(nights_of_other_machines_are_left_out),
        cmocka_unit_test(bad_series_are_refused),
        cmocka_unit_test(a_centre_leaves_out_the_ends),
        cmocka_unit_test(the_standard_error_is_that_of_the_centre),
        cmocka_unit_test(a_step_of_six_percent_is_found_in_three_nights),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
