/* Whose fault it is: workers that die, are killed, or cannot write; parents that are killed. */
#include <setjmp.h>
#include <signal.h>
#include <stdarg.h>
#include <stddef.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <cmocka.h>

#include "fake_worker.h"

/* Stops with FM_IO and no verdict on the case; the same run finishes once there is room. */
static void assert_runs_fault(const char *id, const char *words)
{
    const char *const ids[] = { id, NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    char path[160], row[32];
    snprintf(row, sizeof row, ",%s,7,", id); /* method and version */
    open_with_worker(&fake, ids, 1);
    for (int times = 0; times < 3; times++) { /* never taken for a launch that kills its run */
        assert_int_equal(run_in(&result, &fake, 5, &err), FM_IO);
        assert_false(result.is_damaged);
        assert_non_null(strstr(err.message, words));
        assert_int_equal(count_in_file(&fake, "out/summary.csv", ",skipped,"), 1);
    }
    snprintf(path, sizeof path, "%s/out/work/%s.result.json.partial", fake.folder,
             fake.plan.cases[0].id);
    rmdir(path);
    fake_write(&fake, "room", "", "w");
    assert_int_equal(run_well(&fake).ok, 1);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", row), 1);
    fake_close(&fake);
}

static void run_blames_nobody_for_what_the_run_cannot_write(void **state)
{
    (void)state;
    assert_runs_fault("lost", "disk full");
    assert_runs_fault("full", "partial");
}

/* A method cannot be told from the limit; with the limit gone its row is its own. */
static void run_blames_no_method_for_a_limit_on_memory(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    struct rlimit before;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(getrlimit(RLIMIT_AS, &before), 0);
    const struct rlimit given = { (rlim_t)1 << 50, before.rlim_max };
    assert_int_equal(setrlimit(RLIMIT_AS, &given), 0);
    const fm_status status = run_in(&result, &fake, 5, &err);
    assert_int_equal(setrlimit(RLIMIT_AS, &before), 0);
    assert_int_equal(status, FM_IO);
    assert_non_null(strstr(err.message, "ulimit -v"));
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",skipped,"), 1);
    assert_int_equal(run_well(&fake).failed, 1);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",crash,7,"), 1);
    fake_close(&fake);
}

static void run_does_not_believe_a_worker_that_could_have_answered(void **state)
{
    (void)state;
    static const char *const ids[] = { "liar", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).failed, 1);
    assert_in_file(&fake, "out/summary.csv", "crash,exited with status 74");
    fake_close(&fake);
}

/* A run that was killed leaves a begin without an end, and that tells nothing of the launch. */
static void run_that_was_killed_blames_nobody(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", NULL };
    static const char begin[] =
        "{\"event\":\"begin\",\"case\":\"0000000000000001\",\"launch\":1}\n";
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    *strstr(journal, begin) = '\0';
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    for (int i = 0; i < 5; i++)
        fake_write(&fake, "out/journal.jsonl", begin, "a");
    assert_int_equal(run_well(&fake).ok, 1);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",ok,,a,"), 1);
    free(journal);
    fake_close(&fake);
}

/* The parent in a process of its own, for a worker that kills it. */
static void run_in_child(const fake_plan *fake)
{
    const pid_t pid = fork();
    if (pid == 0) {
        char self[16];
        fm_run_result result;
        snprintf(self, sizeof self, "%d", getpid());
        setenv("FAKE_PARENT", self, 1);
        run_in(&result, fake, 20, NULL);
        _exit(0);
    }
    assert_int_equal(waitpid(pid, NULL, 0), pid);
}

static void run_never_takes_its_own_death_for_evidence(void **state)
{
    (void)state;
    static const char *const ids[] = { "parricide", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    for (int i = 0; i < 4; i++)
        run_in_child(&fake);
    fake_write(&fake, "done", "", "w");
    assert_int_equal(run_well(&fake).ok, 1);
    assert_int_equal(count_in_file(&fake, "calls", "parricide 0"), 5);
    fake_close(&fake);
}

static void run_forgives_one_death_and_tells_of_it(void **state)
{
    (void)state;
    static const char *const ids[] = { "mortal", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).ok, 1);
    assert_int_equal(count_in_file(&fake, "calls", "mortal 0"), 2);
    assert_in_file(&fake, "out/journal.jsonl", "{\"event\":\"died\",\"case\":\"0000000000000001\"");
    assert_in_file(&fake, "out/summary.csv", ",ok,the first time: killed by SIGSEGV,mortal");
    run_well(&fake);
    assert_in_file(&fake, "out/summary.csv", ",ok,the first time: killed by SIGSEGV,mortal");
    fake_close(&fake);
}

/* One death under an earlier parent, one under this one. */
static void run_remembers_a_death_when_it_goes_on(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    *strstr(journal, "{\"event\":\"end\"") = '\0';
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    assert_int_equal(run_well(&fake).failed, 1);
    assert_int_equal(count_in_file(&fake, "calls", "crash 0"), 3);
    assert_in_file(&fake, "out/summary.csv", "and so the first time");
    fake_close(&fake);
}

/* Who mended a method that died does not go on with a death of the old one. */
static void run_does_not_blame_new_code_for_a_death_of_the_old(void **state)
{
    (void)state;
    static const char *const ids[] = { "crash", NULL };
    fake_plan fake;
    fm_run_result result;
    fm_error err = { 0 };
    open_with_worker(&fake, ids, 1);
    run_well(&fake);
    char *journal = fake_read(&fake, "out/journal.jsonl");
    *strstr(journal, "{\"event\":\"end\"") = '\0';
    fake_write(&fake, "out/journal.jsonl", journal, "w");
    free(journal);
    fake_write(&fake, "worker.sh", "# edited\n", "a");
    assert_int_equal(run_in(&result, &fake, 20, &err), FM_INVALID);
    assert_true(result.is_other_code);
    assert_non_null(strstr(err.message, "1 row of crash (program)"));
    fake_close(&fake);
}

static void run_stops_where_workers_are_killed_from_outside(void **state)
{
    (void)state;
    static const char *const ids[] = { "killed", NULL };
    static const char *const signals[] = { "KILL", "TERM", "INT", "HUP" };
    for (size_t i = 0; i < sizeof signals / sizeof signals[0]; i++) {
        fake_plan fake;
        fm_run_result result;
        fm_error err = { 0 };
        char words[64];
        open_with_worker(&fake, ids, 1);
        fake_write(&fake, "how", signals[i], "w");
        snprintf(words, sizeof words, "killed by SIG%s, twice", signals[i]);
        assert_int_equal(run_in(&result, &fake, 20, &err), FM_IO);
        assert_non_null(strstr(err.message, words));
        assert_int_equal(count_in_file(&fake, "calls", "killed 0"), 2);
        assert_int_equal(count_in_file(&fake, "out/summary.csv", "crash"), 0);
        fake_write(&fake, "spared", "", "w");
        assert_int_equal(run_well(&fake).ok, 1);
        fake_close(&fake);
    }
}

/* To all of us, the worker first. */
static void run_is_interrupted_where_the_worker_hears_it_first(void **state)
{
    (void)state;
    static const char *const ids[] = { "together", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    const pid_t parent = getpid(), outside = fork();
    if (outside == 0) {
        char path[96];
        snprintf(path, sizeof path, "%s/stopped", fake.folder);
        while (access(path, F_OK) != 0)
            usleep(10000);
        usleep(100000);
        _exit(kill(parent, SIGHUP));
    }
    const fm_run_result result = run_well(&fake);
    assert_int_equal(waitpid(outside, NULL, 0), outside);
    assert_int_equal(result.stop_signal, SIGHUP);
    assert_int_equal(result.failed, 0);
    assert_int_equal(result.skipped, 1);
    assert_int_equal(run_well(&fake).ok, 1);
    fake_close(&fake);
}

static void run_leaves_no_heir_of_a_worker(void **state)
{
    (void)state;
    static const char *const ids[] = { "heir", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).ok, 1);
    char *pid = fake_read(&fake, "pid");
    assert_true(strtol(pid, NULL, 10) > 1);
    assert_int_equal(kill((pid_t)strtol(pid, NULL, 10), 0), -1);
    free(pid);
    fake_close(&fake);
}

static void run_keeps_a_flood_of_words_out_of_its_folder(void **state)
{
    (void)state;
    static const char *const ids[] = { "flood", NULL };
    fake_plan fake;
    struct stat info;
    char path[128];
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).failed, 1);
    snprintf(path, sizeof path, "%s/out/work/0000000000000001.log", fake.folder);
    assert_int_equal(stat(path, &info), 0);
    assert_true(info.st_size > 1000000 && info.st_size < 1100000);
    assert_in_file(&fake, "out/summary.csv", "xxxxend");
    fake_close(&fake);
}

static void run_tries_a_starved_launch_again_before_it_judges(void **state)
{
    (void)state;
    static const char *const ids[] = { "starved", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 1);
    assert_int_equal(run_well(&fake).failed, 1);
    assert_int_equal(count_in_file(&fake, "calls", "starved 0"), 2);
    assert_in_file(&fake, "out/summary.csv", "wrong_image,lost 3; and so the first time,starved");
    fake_close(&fake);
}

static void run_stops_on_sigterm_and_continues(void **state)
{
    (void)state;
    static const char *const ids[] = { "a", "stops", NULL };
    fake_plan fake;
    open_with_worker(&fake, ids, 2);
    fm_run_result result = run_well(&fake);
    assert_int_equal(result.stop_signal, SIGTERM);
    assert_true(result.skipped > 0);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "\n1,"), 2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", ",skipped,the run was stopped"), 2);
    assert_in_file(&fake, "out/manifest.json", "\"ended\": null");
    assert_int_equal(count_in_file(&fake, "out/journal.jsonl", "\"stop\""), 1);
    result = run_well(&fake);
    assert_int_equal(result.stop_signal, 0);
    assert_int_equal(result.ok, 2);
    assert_int_equal(count_in_file(&fake, "out/summary.csv", "skipped"), 0);
    assert_int_equal(count_in_file(&fake, "out/samples.csv", "frame_ms"), 8);
    assert_int_equal(count_in_file(&fake, "calls", "a 0"), 1);
    fake_close(&fake);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(run_blames_nobody_for_what_the_run_cannot_write),
        cmocka_unit_test(run_blames_no_method_for_a_limit_on_memory),
        cmocka_unit_test(run_does_not_believe_a_worker_that_could_have_answered),
        cmocka_unit_test(run_that_was_killed_blames_nobody),
        cmocka_unit_test(run_never_takes_its_own_death_for_evidence),
        cmocka_unit_test(run_forgives_one_death_and_tells_of_it),
        cmocka_unit_test(run_remembers_a_death_when_it_goes_on),
        cmocka_unit_test(run_does_not_blame_new_code_for_a_death_of_the_old),
        cmocka_unit_test(run_stops_where_workers_are_killed_from_outside),
        cmocka_unit_test(run_is_interrupted_where_the_worker_hears_it_first),
        cmocka_unit_test(run_leaves_no_heir_of_a_worker),
        cmocka_unit_test(run_keeps_a_flood_of_words_out_of_its_folder),
        cmocka_unit_test(run_tries_a_starved_launch_again_before_it_judges),
        cmocka_unit_test(run_stops_on_sigterm_and_continues),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
