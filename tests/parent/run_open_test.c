/* Runs whose launches somebody else chooses: a shell script plays the worker. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

#include "parent/fake_worker.h"
#include "parent/run_open.h"

/* One open run of a fake plan. */
typedef struct open_run {
    fake_plan fake;
    char directory[96];
    fm_run_desc desc;
    fm_open_run *run;
} open_run;

static void begin(open_run *of, const char *const *ids, uint32_t launches)
{
    open_with_worker(&of->fake, ids, launches);
    snprintf(of->directory, sizeof of->directory, "%s/out", of->fake.folder);
    of->desc = (fm_run_desc){ .directory = of->directory,
                              .command = "fragmark",
                              .timeout_s = 20,
                              .worker = of->fake.worker };
}

static void open_it(open_run *of)
{
    fm_error err = { 0 };
    if (run_open(&of->run, &of->fake.plan, &of->fake.list, &of->desc, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static void launch(open_run *of, size_t case_index, uint32_t number)
{
    fm_error err = { 0 };
    if (run_launch(of->run, case_index, number, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static fm_run_result close_it(open_run *of)
{
    fm_run_result result;
    assert_int_equal(run_close(&result, of->run, FM_OK, NULL), FM_OK);
    return result;
}

static void launches_run_in_the_order_that_is_asked_for(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 1, 2);
    launch(&of, 0, 0);
    launch(&of, 1, 2); /* it is done */
    launch(&of, 1, 0);
    assert_int_equal(run_results(of.run)->cases[1].done, 2);
    assert_true(run_results(of.run)->cases[1].launches[2].is_done);
    char *calls = fake_read(&of.fake, "calls");
    assert_string_equal(calls, "truth\nb 2\na 0\nb 0\n"); /* the truth of both, once */
    free(calls);
    close_it(&of);
    fake_close(&of.fake);
}

static void settled_cases_are_finished_and_others_are_not(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 0, 0);
    run_settle(of.run);
    launch(&of, 0, 1); /* no further one is wanted */
    const fm_run_result result = close_it(&of);
    assert_int_equal(result.ok, 1);
    assert_int_equal(result.skipped, 1);
    assert_int_equal(count_in_file(&of.fake, "calls", "a "), 1);
    assert_int_equal(count_in_file(&of.fake, "out/summary.csv", "the run is not finished"), 0);
    fake_close(&of.fake);
}

static void unsettled_run_says_that_it_is_not_finished(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 0, 0);
    close_it(&of);
    assert_in_file(&of.fake, "out/summary.csv", "1 of 3 launches so far: the run is not finished");
    fake_close(&of.fake);
}

static void what_was_launched_is_known_to_the_next_process(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 0, 1);
    close_it(&of);
    open_it(&of);
    assert_int_equal(run_results(of.run)->cases[0].done, 1);
    launch(&of, 0, 1);
    launch(&of, 0, 0);
    close_it(&of);
    assert_int_equal(count_in_file(&of.fake, "calls", "a 1"), 1);
    fake_close(&of.fake);
}

static void case_that_failed_is_not_launched_again(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 0, 0); /* and tried again, once */
    launch(&of, 0, 1);
    assert_int_equal(run_results(of.run)->cases[0].status, FM_CASE_CRASH);
    assert_int_equal(count_in_file(&of.fake, "calls", "crash"), 2);
    close_it(&of);
    fake_close(&of.fake);
}

static void signal_stops_what_follows(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    open_run of;
    begin(&of, ids, 3);
    open_it(&of);
    launch(&of, 0, 0);
    kill(getpid(), SIGTERM); /* blocked while runs are open, and read from there */
    assert_int_equal(run_stop_signal(of.run), SIGTERM);
    launch(&of, 0, 1);
    assert_int_equal(run_results(of.run)->cases[0].done, 1);
    assert_int_equal(close_it(&of).stop_signal, SIGTERM);
    fake_close(&of.fake);
}

static void failed_open_is_closed_too(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    open_run of;
    fm_error err = { 0 };
    fm_run_result result;
    begin(&of, ids, 3);
    fake_write(&of.fake, "out", "no folder", "w");
    assert_int_equal(run_open(&of.run, &of.fake.plan, &of.fake.list, &of.desc, &err), FM_INVALID);
    assert_int_equal(run_close(&result, of.run, FM_INVALID, &err), FM_INVALID);
    assert_int_equal(run_close(&result, NULL, FM_OK, NULL), FM_OK);
    fake_close(&of.fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(launches_run_in_the_order_that_is_asked_for),
        cmocka_unit_test(settled_cases_are_finished_and_others_are_not),
        cmocka_unit_test(unsettled_run_says_that_it_is_not_finished),
        cmocka_unit_test(what_was_launched_is_known_to_the_next_process),
        cmocka_unit_test(case_that_failed_is_not_launched_again),
        cmocka_unit_test(signal_stops_what_follows),
        cmocka_unit_test(failed_open_is_closed_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
