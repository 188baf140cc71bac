/* Which rows are marked as noisy, and why. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>
#include <math.h>

#include "kit/fake_plan.h"
#include "results/noise.h"
#include "results/results.h"

/* One launch: a frame of so many ms; of a second of timed frames, what it worked and waited. */
typedef struct fake_launch {
    double frame_ms, cpu_s, waited_s, throttled_s, thermal;
    bool is_gpu;
} fake_launch;

static json_t *answer_of(const fake_launch *launch)
{
    return json_pack("{s:s, s:s, s:b, s:[{s:i, s:s, s:f, s:s}], s:{s:f, s:f, s:f, s:f, s:f, s:f}}",
                     "status", "ok", "device_name", "soft", "is_software", (int)!launch->is_gpu,
                     "samples", "frame", 0, "metric", "frame_ms", "value", launch->frame_ms, "unit",
                     "ms", "launch", "timed_s", 1.0, "timed_cpu_s", launch->cpu_s, "waited_s",
                     launch->waited_s, "throttled_s", launch->throttled_s, "thermal_events",
                     launch->thermal, "load_end", 7.5);
}

/* The reasons for the row of these launches; the host's load beside. */
static void judge(char reasons[256], fm_noise_host *host, const fake_launch *launches,
                  uint32_t count)
{
    static const char *const only_kb[] = { "kb", NULL };
    fake_plan fake;
    fm_results *results = NULL;
    fm_text text = { 0 };
    fake_open(&fake, only_kb, count);
    assert_int_equal(results_create(&results, &fake.plan, &fake.list, fake.folder, "run", NULL),
                     FM_OK);
    for (uint32_t i = 0; i < count; i++) {
        json_t *answer = answer_of(&launches[i]);
        assert_int_equal(results_add(results, 0, i, answer, NULL), FM_OK);
        json_decref(answer);
    }
    summary_noise(&text, results, 0);
    assert_false(text.failed);
    snprintf(reasons, 256, "%s", text.bytes != NULL ? text.bytes : "");
    assert_int_equal(noise_of_host(host, results, NULL), FM_OK);
    text_free(&text);
    results_destroy(results);
    fake_close(&fake);
}

static void expect(const char *expected, const fake_launch *launches, uint32_t count)
{
    char reasons[256];
    fm_noise_host host;
    judge(reasons, &host, launches, count);
    assert_string_equal(reasons, expected);
}

static void a_quiet_machine_marks_nothing(void **state)
{
    (void)state;
    const fake_launch quiet[] = { { 10, 1.5, 0.03, 0, 0, false },
                                  { 11, 1.5, 0.02, 0, 0, false },
                                  { 12, 1.5, 0.10, 0, 0, false } };
    expect("", quiet, 3);
}

static void threads_that_wait_mark_a_row(void **state)
{
    (void)state;
    const fake_launch busy[] = { { 10, 0.5, 0.5, 0, 0, false },
                                 { 10, 0.6, 0.4, 0, 0, false },
                                 { 10, 1.5, 0.0, 0, 0, false } };
    expect("threads waited for a processor 40 % of the time", busy, 3);
}

/* The median of the launches is then one of the undisturbed ones. */
static void one_disturbed_launch_of_three_marks_nothing(void **state)
{
    (void)state;
    const fake_launch once[] = { { 10, 0.5, 0.5, 0, 0, false },
                                 { 10, 1.5, 0.0, 0, 0, false },
                                 { 10, 1.5, 0.0, 0, 0, false } };
    expect("", once, 3);
}

static void a_gpu_does_not_need_the_hosts_processors(void **state)
{
    (void)state;
    const fake_launch busy[] = { { 10, 0.1, 0.9, 0, 0, true }, { 10, 0.1, 0.9, 0, 0, true } };
    expect("", busy, 2);
}

static void launches_that_differ_mark_a_row(void **state)
{
    (void)state;
    const fake_launch apart[] = { { 10, 1.5, 0, 0, 0, true }, { 21, 1.5, 0, 0, 0, true } };
    expect("launches differ by a factor of 2.1", apart, 2);
}

static void throttling_marks_a_row(void **state)
{
    (void)state;
    const fake_launch stopped[] = { { 10, 1.5, 0, 0.5, 0, false }, { 10, 1.5, 0, 0, 0, false } };
    const fake_launch hot[] = { { 10, 1.5, 0, 0, 2, true }, { 10, 1.5, 0, 0, 1, true } };
    expect("the processors were throttled in 1 of 2 launches", stopped, 2);
    expect("the processors were throttled in 2 of 2 launches", hot, 2);
}

static void reasons_are_told_together(void **state)
{
    (void)state;
    const fake_launch all[] = { { 10, 0.5, 0.5, 1, 0, false }, { 20, 0.5, 0.5, 1, 0, false } };
    expect("threads waited for a processor 50 % of the time; the processors were throttled in 2 of "
           "2 launches; launches differ by a factor of 2",
           all, 2);
}

static void the_host_is_described_by_all_launches(void **state)
{
    (void)state;
    char reasons[256];
    fm_noise_host host;
    const fake_launch busy[] = { { 10, 0.5, 0.5, 0, 0, false }, { 10, 0.75, 0.25, 0, 0, false } };
    const fake_launch gpu[] = { { 10, 0.5, 0.5, 0, 0, true } };
    judge(reasons, &host, busy, 2);
    assert_true(host.load == 7.5 && fabs(host.waited_share - 0.375) < 1e-9);
    judge(reasons, &host, gpu, 1);
    assert_true(isnan(host.waited_share));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_quiet_machine_marks_nothing),
        cmocka_unit_test(threads_that_wait_mark_a_row),
        cmocka_unit_test(one_disturbed_launch_of_three_marks_nothing),
        cmocka_unit_test(a_gpu_does_not_need_the_hosts_processors),
        cmocka_unit_test(launches_that_differ_mark_a_row),
        cmocka_unit_test(throttling_marks_a_row),
        cmocka_unit_test(reasons_are_told_together),
        cmocka_unit_test(the_host_is_described_by_all_launches),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
