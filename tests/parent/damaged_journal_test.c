/* Journals that were damaged, and workers that say what cannot be: nothing is lost, nothing is
 * believed. With a shell script in a worker's place. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "kit/fake_plan.h"
#include "parent/run.h"

/* $2 is the request, $3 the result. What a method says is told by its name. */
static const char worker_script[] =
    "#!/bin/sh\n"
    "here=$(dirname \"$0\")\n"
    "good='{\"status\":\"ok\",\"metrics\":{\"rmse\":0.0},\"samples\":['\n"
    "good=$good'{\"frame\":0,\"metric\":\"frame_ms\",\"value\":2.0,\"unit\":\"ms\"},'\n"
    "good=$good'{\"frame\":1,\"metric\":\"frame_ms\",\"value\":4.0,\"unit\":\"ms\"}]}'\n"
    "method=$(sed -n 's,.*\"plugin\": \"/fake/\\(.*\\).so\".*,\\1,p' \"$2\")\n"
    "if grep -q '\"job\": \"truth\"' \"$2\"; then\n"
    "    touch \"$(sed -n 's,.*\"truth\": \"\\(.*\\)\".*,\\1,p' \"$2\")\"\n"
    "    echo '{\"status\":\"ok\"}' >\"$3\"\n"
    "    exit 0\n"
    "fi\n"
    "echo \"$method\" >>\"$here/calls\"\n"
    "case $method in\n"
    "negative) good=$(echo \"$good\" | sed s/2.0/-5/) ;;\n"
    "late) good=$(echo \"$good\" | sed s/:1,/:2,/) ;;\n"
    "twice) good=$(echo \"$good\" | sed s/:1,/:0,/) ;;\n"
    "double) good=$(echo \"$good\" | sed 's/^{/{\"status\":\"crash\",/') ;;\n"
    "pipe) mkfifo \"$3\"; exit 0 ;;\n"
    "esac\n"
    "echo \"$good\" >\"$3\"\n";

static void open_with_worker(fake_plan *fake, const char *const *ids, uint32_t launches)
{
    fake_open(fake, ids, launches);
    fake_write(fake, "worker.sh", worker_script, "w");
    assert_int_equal(chmod(fake->worker, 0755), 0);
}

static fm_status run_in(fm_run_result *result, const fake_plan *fake, fm_error *err)
{
    char directory[96];
    snprintf(directory, sizeof directory, "%s/out", fake->folder);
    const fm_run_desc desc = { .directory = directory, .timeout_s = 60, .worker = fake->worker };
    return run_cases(result, &fake->plan, &fake->list, &desc, err);
}

static void run_well(const fake_plan *fake)
{
    fm_run_result result;
    fm_error err = { 0 };
    if (run_in(&result, fake, &err) != FM_OK)
        fail_msg("%s", err.message);
}

static size_t count_in_file(const fake_plan *fake, const char *name, const char *words)
{
    size_t count = 0;
    char *text = fake_read(fake, name);
    for (const char *at = text; at != NULL && (at = strstr(at, words)) != NULL; at++)
        count++;
    free(text);
    return count;
}

static void answers_that_cannot_be_are_the_workers_fault(void **state)
{
    (void)state;
    static const char *const ids[] = {
        "double", "good", "late", "negative", "pipe", "twice", NULL
    };
    static const char *const words[] = {
        "the worker's result cannot be used: line 1: duplicate object key",
        "the worker's result cannot be used: a sample is of frame 2; there are 2",
        "the worker's result cannot be used: 'frame_ms' is -5, not a number from 0",
        ".result.json: is a pipe, not a file",
        "the worker's result cannot be used: frame 0 has 'frame_ms' twice",
    };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_in(&result, &fake, &err), FM_OK);
    assert_int_equal(result.ok, 1);
    assert_int_equal(result.failed, 5);
    for (size_t i = 0; i < sizeof words / sizeof words[0]; i++)
        if (count_in_file(&fake, "out/summary.csv", words[i]) != 1)
            fail_msg("no row says '%s': %s", words[i], fake_read(&fake, "out/summary.csv"));
    assert_int_equal(count_in_file(&fake, "out/samples.csv", ",frame_ms,"), 2);
    fake_close(&fake);
}

/* Runs once, adds lines to the journal, runs again: nothing may change, and the command that the
 * message tells must lead on, with the old journal kept. */
static void assert_damage_costs_nothing(const char *lines, const char *words)
{
    static const char *const ids[] = { "a", NULL };
    static const char *const files[] = { "out/journal.jsonl", "out/samples.csv",
                                         "out/summary.csv" };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    char *before[3], command[2048] = "";
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    fake_write(&fake, files[0], lines, "a");
    for (size_t i = 0; i < 3; i++)
        before[i] = fake_read(&fake, files[i]);
    assert_int_equal(run_in(&result, &fake, &err), FM_IO);
    assert_true(result.is_damaged);
    if (strstr(err.message, words) == NULL)
        fail_msg("'%s' lacks '%s'", err.message, words);
    for (size_t i = 0; i < 3; i++) {
        char *after = fake_read(&fake, files[i]);
        assert_string_equal(before[i], after);
        free(after);
    }
    assert_null(fake_read(&fake, "out/samples.csv.partial"));
    assert_int_equal(sscanf(strstr(err.message, "`sed"), "`%2047[^`]", command), 1);
    assert_int_equal(system(command), 0);
    run_well(&fake);
    char *kept = fake_read(&fake, "out/journal.jsonl.damaged");
    assert_string_equal(kept, before[0]);
    free(kept);
    assert_int_equal(count_in_file(&fake, "calls", "a"), 1); /* and it was not measured again */
    for (size_t i = 0; i < 3; i++)
        free(before[i]);
    fake_close(&fake);
}

static void a_damaged_journal_costs_nothing(void **state)
{
    (void)state;
    static const char end[] = "{\"event\":\"end\",\"case\":\"0000000000000001\",\"launch\":0,"
                              "\"result\":{\"status\":\"ok\"}}\n";
    assert_damage_costs_nothing("{\"event\":\"begin\",\"case\":\"ffffffffffffffff\","
                                "\"launch\":0}\n",
                                "is not of this plan");
    assert_damage_costs_nothing("\n", "not JSON");
    assert_damage_costs_nothing(end, "launch 0 ended twice");
    assert_damage_costs_nothing("{\"event\":\"begin\",\"case\":\"0000000000000001\","
                                "\"launch\":0}\n",
                                "launch 0 begins after its end");
    assert_damage_costs_nothing("{\"event\":\"stop\",\"case\":\"0000000000000001\","
                                "\"launch\":0}\n",
                                "launch 0 stops and had not begun");
}

/* An answer that was edited in the journal is no better than one that a worker made up. */
static void answers_in_the_journal_are_checked(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    char *value = strstr(journal, "\"value\":2.0");
    assert_non_null(value);
    memcpy(value, "\"value\":-20", 11);
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    assert_int_equal(run_in(&result, &fake, &err), FM_IO);
    assert_true(result.is_damaged);
    assert_non_null(
        strstr(err.message, "journal.jsonl:3: damaged: 'frame_ms' is -20, not a number"));
    fake_close(&fake);
}

/* The launches of a plan may be as many as before, and those of a case others: sequences. */
static void journal_of_other_launches_is_of_another_plan(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "b", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 2);
    run_well(&fake);
    fake.cases[1].settings.launches = 1;
    assert_int_equal(run_in(&result, &fake, &err), FM_INVALID);
    assert_false(result.is_damaged);
    assert_non_null(strstr(err.message, "belongs to another plan"));
    fake_close(&fake);
}

static void results_whose_journal_is_empty_are_refused(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    static const char *const left[] = { "", "{\"event\":\"plan\",\"pl" };
    for (size_t i = 0; i < 2; i++) {
        fake_plan fake;
        fm_run_result result;
        fm_error err = { 0 };
        open_with_worker(&fake, ids, 1);
        run_well(&fake);
        fake_write(&fake, "out/journal.jsonl", left[i], "w");
        assert_int_equal(run_in(&result, &fake, &err), FM_INVALID);
        assert_non_null(strstr(err.message, "no journal"));
        assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 2);
        fake_close(&fake);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers_that_cannot_be_are_the_workers_fault),
        cmocka_unit_test(a_damaged_journal_costs_nothing),
        cmocka_unit_test(answers_in_the_journal_are_checked),
        cmocka_unit_test(journal_of_other_launches_is_of_another_plan),
        cmocka_unit_test(results_whose_journal_is_empty_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
